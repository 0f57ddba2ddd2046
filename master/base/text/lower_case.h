#ifndef STRIDE_MASTER_BASE_TEXT_LOWER_CASE_H
#define STRIDE_MASTER_BASE_TEXT_LOWER_CASE_H

#include <algorithm>
#include <cctype>
#include <string>

namespace stride::core {

/// With the small letters of ASCII in place of its capital ones.
inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace stride::core

#endif
