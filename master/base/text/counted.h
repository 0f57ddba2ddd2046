#ifndef STRIDE_MASTER_BASE_TEXT_COUNTED_H
#define STRIDE_MASTER_BASE_TEXT_COUNTED_H

#include <concepts>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace stride::core {

/// "1 case", "2 cases". `plural`: of a word that does not take an "s", "2 boxes".
template <std::integral Count>
std::string counted(Count count, std::string_view word, std::string_view plural = {}) {
  if (count == 1) return fmt::format("1 {}", word);
  return plural.empty() ? fmt::format("{} {}s", count, word) : fmt::format("{} {}", count, plural);
}

}  // namespace stride::core

#endif
