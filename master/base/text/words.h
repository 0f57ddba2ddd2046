#ifndef STRIDE_MASTER_BASE_TEXT_WORDS_H
#define STRIDE_MASTER_BASE_TEXT_WORDS_H

#include <algorithm>
#include <string>
#include <vector>

namespace stride::core {

/// What is between blanks.
inline std::vector<std::string> words_of(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBlanks, at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace stride::core

#endif
