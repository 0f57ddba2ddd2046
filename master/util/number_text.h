// Numbers as they are written in scenarios and on the command line.
#ifndef STRIDE_MASTER_UTIL_NUMBER_TEXT_H
#define STRIDE_MASTER_UTIL_NUMBER_TEXT_H

#include <string_view>

namespace stride::core {

/// Each takes the text of a finite number. Throws std::invalid_argument whose text contains what
/// was expected.
double parse_at_least_zero(std::string_view text);
double parse_above_zero(std::string_view text);

}  // namespace stride::core

#endif
