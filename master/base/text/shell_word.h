// Words of a command line.
#ifndef STRIDE_MASTER_BASE_TEXT_SHELL_WORD_H
#define STRIDE_MASTER_BASE_TEXT_SHELL_WORD_H

#include <string>

namespace stride::core {

/// The text as one word of a command line of a POSIX shell: in quotation marks where it needs them.
std::string shell_word(const std::string& text);

}  // namespace stride::core

#endif
