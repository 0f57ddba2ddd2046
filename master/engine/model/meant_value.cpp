#include "master/engine/model/meant_value.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "master/base/text/lower_case.h"
#include "master/base/text/words.h"
#include "master/engine/model/number_range.h"

namespace stride::core {
namespace {

/// Written with a fraction or an exponent.
std::string whole_decimal(std::string_view word) {
  constexpr double kLastExact = 9007199254740992;  // 2^53: beyond it, doubles leave integers out
  constexpr std::string_view kCharacters = "0123456789.eE+-";
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = word.find_first_not_of(kCharacters) == word.npos &&
                         end == word.data() + word.size() && error == std::errc{};
  const bool is_whole = is_number && std::abs(number) < kLastExact && std::trunc(number) == number;
  return is_whole ? fmt::format("{}", static_cast<std::int64_t>(number)) : "";
}

/// The "2" of "2", "+2", "2.0" and "2e0"; empty for what is no whole number.
std::string whole_number(std::string_view word) {
  constexpr std::string_view kDigits = "0123456789";
  const bool has_plus = word.starts_with('+');
  if (has_plus) word.remove_prefix(1);
  const std::size_t digits = !has_plus && word.starts_with('-') ? 1 : 0;
  if (word.size() == digits || kDigits.find(word[digits]) == kDigits.npos) return "";
  const bool is_plain = word.find_first_not_of(kDigits, digits) == word.npos;
  return is_plain ? std::string(word) : whole_decimal(word);
}

std::string meant_boolean(const std::string& word) {
  const std::string lower = lower_case(word);
  if (lower == "true" || lower == "false") return lower;
  const std::string number = whole_number(word);
  if (number.empty() || word == "0" || word == "1") return word;
  return number.find_first_not_of("-0") == number.npos ? "false" : "true";
}

/// A word of such a text, or the word itself.
std::string meant_word(ValueType type, const std::string& word) {
  if (type == ValueType::Boolean) return meant_boolean(word);
  const std::string lower = lower_case(word);
  if (lower == "true" || lower == "false") return lower == "true" ? "1" : "0";
  if (is_real(type)) return word;
  const std::string number = whole_number(word);
  return number.empty() || word == "+" + number ? word : number;
}

}  // namespace

std::optional<std::string> meant_value(ValueType type, const std::string& text) {
  const bool may_differ = is_number(type) || type == ValueType::Boolean;
  if (!may_differ) return std::nullopt;
  std::string meant;
  bool differs = false;
  for (const std::string& word : words_of(text)) {
    const std::string value = meant_word(type, word);
    differs |= value != word;
    meant += (meant.empty() ? "" : " ") + value;
  }
  return differs ? std::optional(meant) : std::nullopt;
}

}  // namespace stride::core
