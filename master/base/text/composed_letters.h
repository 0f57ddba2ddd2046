// Letters with marks, which Unicode writes in two ways.
#ifndef STRIDE_MASTER_BASE_TEXT_COMPOSED_LETTERS_H
#define STRIDE_MASTER_BASE_TEXT_COMPOSED_LETTERS_H

#include <string>
#include <string_view>

namespace stride::core {

/// A text of UTF-8 with one character for each Latin letter with one mark, as in the normal form C
/// of Unicode. Names of files from macOS have two (form D).
std::string composed(std::string_view text);

}  // namespace stride::core

#endif
