#include "units/player/values.h"

#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <stride/value_text.h>

namespace player {
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

}  // namespace

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
