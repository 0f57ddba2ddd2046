// Numbers as they are written in files and on the command line.
#ifndef STRIDE_MASTER_BASE_TEXT_NUMBER_TEXT_H
#define STRIDE_MASTER_BASE_TEXT_NUMBER_TEXT_H

#include <string_view>

namespace stride::core {

/// Each takes the text of a finite number. Throws std::invalid_argument whose text contains what
/// was expected.
double parse_at_least_zero(std::string_view text);
double parse_above_zero(std::string_view text);

/// Of a number that std::from_chars() finds out of range: whether it is too near to 0, which it is
/// to be rounded to then.
bool is_tiny_number(std::string_view text);

}  // namespace stride::core

#endif
