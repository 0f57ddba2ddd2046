#ifndef STRIDE_MASTER_UTIL_UTF8_H
#define STRIDE_MASTER_UTIL_UTF8_H

#include <string_view>

namespace stride::core {

/// Stands for what is no character.
inline constexpr std::string_view kReplacement = "\uFFFD";

/// Takes the first character of UTF-8 off a text that is not empty. A byte that is not of one
/// counts as the character U+FFFD.
std::string_view take_character(std::string_view& text);

}  // namespace stride::core

#endif
