#include "units/player/values.h"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <stride/value_text.h>

namespace player {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

namespace {

template <std::size_t... I>
std::array<Values, sizeof...(I)> one_of_each(std::index_sequence<I...>) {
  return {Values(std::in_place_index<I>)...};
}

/// The alternative of Values that holds the values of a type.
std::size_t place_of(Type type) {
  if (type == Type::Enumeration) type = Type::Int64;
  if (type == Type::Clock) type = Type::Boolean;
  return static_cast<std::size_t>(type);
}

std::string plain_truth(const std::string& text) {
  for (const char* word : {"true", "True", "TRUE", "1"}) {
    if (text == word) return "true";
  }
  for (const char* word : {"false", "False", "FALSE", "0"}) {
    if (text == word) return "false";
  }
  return text;
}

/// Without its sign, which std::from_chars() does not know.
std::string without_plus(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return has_plus ? text.substr(1) : text;
}

/// "2.0", which is how a column of integers is written by tools in which it has numbers, "2".
std::string plain_integer(const std::string& text) {
  constexpr double kMost = 9007199254740992.0;  // up to here each integer is a double
  double number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, mistake] = std::from_chars(text.data(), last, number);
  const bool is_integer = mistake == std::errc() && end == last && std::abs(number) <= kMost &&
                          number == std::floor(number);
  if (!is_integer || text.find_first_of(".eE") == std::string::npos) return text;
  return std::to_string(static_cast<std::int64_t>(number));
}

}  // namespace

std::string plain_value(Type type, const std::string& text) {
  if (type == Type::String) return text;
  const std::string word = trimmed(text);
  if (type == Type::Binary) return word;
  if (type == Type::Boolean) return plain_truth(word);
  const std::string number = without_plus(word);
  return type == Type::Float64 || type == Type::Float32 ? number : plain_integer(number);
}

Type type_named(const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < std::size(stride::kTypeNames); ++i) {
    if (name == stride::kTypeNames[i]) return static_cast<Type>(i);
    known.append(i == 0 ? "" : ", ").append(stride::kTypeNames[i]);
  }
  throw std::invalid_argument("'" + name + "' is not a type; expected " + known);
}

Values values_of(Type type) {
  return one_of_each(std::make_index_sequence<std::variant_size_v<Values>>())[place_of(type)];
}

void append_parsed(Values& values, Type type, const std::string& text) {
  std::visit(
      [&](auto& list) {
        typename std::decay_t<decltype(list)>::value_type value{};
        stride::parse_value(text, value, stride::type_name(type));
        list.push_back(std::move(value));
      },
      values);
}

}  // namespace player
