// The words and numbers in an attribute's value.
#ifndef STRIDE_MASTER_UTIL_XML_WORDS_H
#define STRIDE_MASTER_UTIL_XML_WORDS_H

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace stride::xml {

/// The words of a list (xs:list).
std::vector<std::string_view> split(std::string_view list);

/// The whole word as a number (xs:int and its kin, xs:float, xs:double).
template <class T>
std::optional<T> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace stride::xml

#endif
