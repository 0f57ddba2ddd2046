#include "master/model/meant_value.h"

#include <algorithm>

#include "master/model/number_range.h"
#include "master/util/lower_case.h"
#include "master/util/words.h"

namespace stride::core {
namespace {

/// The "2" of "2" and "2.0"; empty for what is no whole number.
std::string whole_number(const std::string& word) {
  const std::size_t digits = word.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(word.find_first_not_of("0123456789", digits), word.size());
  if (end == digits) return "";
  const bool is_whole =
      end == word.size() || (word[end] == '.' && word.find_first_not_of('0', end + 1) == word.npos);
  return is_whole ? word.substr(0, end) : "";
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
  return number.empty() ? word : number;
}

}  // namespace

std::optional<std::string> meant_value(ValueType type, const std::string& text) {
  const bool is_number = range_of(type) && type != ValueType::Enumeration;
  const bool may_differ = is_number || type == ValueType::Boolean;
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
