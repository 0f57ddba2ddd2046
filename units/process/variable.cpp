#include "units/process/variable.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace process {
namespace {

namespace text = stride::process;

template <std::size_t... I>
std::array<Value, sizeof...(I)> one_of_each(std::index_sequence<I...>) {
  return {Value(std::in_place_index<I>)...};
}

}  // namespace

Value value_of_type(std::string_view type) {
  std::string known;
  for (const Value& value : one_of_each(std::make_index_sequence<std::variant_size_v<Value>>())) {
    if (type == type_of(value)) return value;
    known.append(known.empty() ? "" : ", ").append(type_of(value));
  }
  throw std::invalid_argument("type=\"" + std::string(type) + "\" is not known: expected " + known);
}

const char* type_of(const Value& value) {
  return std::visit(
      [](const auto& held) { return text::type_name<std::decay_t<decltype(held)>>(); }, value);
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
