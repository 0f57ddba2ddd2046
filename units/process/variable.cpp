#include "units/process/variable.h"

#include <functional>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace process {
namespace {

namespace text = stride::process;

template <class T>
struct ElementOf {
  using Type = T;
};
template <class T>
struct ElementOf<std::valarray<T>> {
  using Type = T;
};

Value scalar_of_type(std::string_view type) {
  const Value scalars[] = {float{},        double{},        std::int8_t{},  std::uint8_t{},
                           std::int16_t{}, std::uint16_t{}, std::int32_t{}, std::uint32_t{},
                           std::int64_t{}, std::uint64_t{}, bool{},         std::string{},
                           Binary{}};
  std::string known;
  for (const Value& value : scalars) {
    const char* const name = stride::type_name(type_of(value));
    if (type == name) return value;
    known.append(known.empty() ? "" : ", ").append(name);
  }
  throw std::invalid_argument("type=\"" + std::string(type) + "\" is not known: expected " + known);
}

}  // namespace

Value value_of_type(std::string_view type, const std::vector<std::size_t>& dimensions) {
  const Value scalar = scalar_of_type(type);
  if (dimensions.empty()) return scalar;
  const std::size_t size =
      std::accumulate(dimensions.begin(), dimensions.end(), std::size_t{1}, std::multiplies<>());
  return std::visit(
      [size](const auto& held) -> Value {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_arithmetic_v<T>) {
          return std::valarray<T>(T{}, size);
        } else {
          throw std::invalid_argument("dimensions: expected of numbers and Booleans only");
        }
      },
      scalar);
}

stride::Type type_of(const Value& value) {
  return std::visit(
      [](const auto& held) {
        using T = typename ElementOf<std::decay_t<decltype(held)>>::Type;
        return stride::detail::type_of<T>();
      },
      value);
}

void parse(std::string_view text, Value& value) {
  std::visit([&](auto& held) { text::parse_value(text, held); }, value);
}

void write(text::TagWriter& tag, std::string_view attribute, const Value& value) {
  std::visit([&](const auto& held) { tag.value(attribute, held); }, value);
}

bool is_same(const Value& one, const Value& other) {
  return std::visit(
      [&](const auto& held) {
        return text::is_same(held, std::get<std::decay_t<decltype(held)>>(other));
      },
      one);
}

}  // namespace process
