#include "master/algorithm/exchange/item_check.h"

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <string>

#include <fmt/format.h>

#include "master/model/item_text.h"
#include "master/util/error.h"

namespace stride::core {
namespace {

[[noreturn]] void fail_item(const System& system, VariableId id, std::int64_t number, Time time) {
  fail_run({{}, system.components()[id.component].name, system.variable(id).name, time},
           fmt::format("the unit gives {}, which is not an item of its Enumeration: {}", number,
                       item_text(system.variable(id).items)),
           "the unit must give one of its items, or its description must list this one");
}

bool has_items(const Variable& variable) {
  return variable.type == ValueType::Enumeration && !variable.items.empty();
}

}  // namespace

void check_items(const System& system, VariableId id, const ValueBlock& value, Time time) {
  const Variable& variable = system.variable(id);
  if (!has_items(variable)) return;
  const auto items = variable.items | std::views::values;
  for (const std::int64_t number : value.numbers<std::int64_t>()) {
    if (std::ranges::find(items, number) == items.end()) fail_item(system, id, number, time);
  }
}

void check_valid(const System& system, VariableId from, VariableId to,
                 std::span<const std::int64_t> valid, const ValueSlice& value, Time time) {
  const auto numbers = value.block->numbers<std::int64_t>().subspan(value.first, value.size);
  for (const std::int64_t number : numbers) {
    if (std::ranges::binary_search(valid, number)) [[likely]]
      continue;
    const std::string unit = system.is_output(to) ? "" : system.components()[to.component].name;
    fail_run({{}, unit, system.variable(to).name, time},
             fmt::format("'{}' gives it {}, which is not an item of its Enumeration: {}",
                         system.full_name(from), number, item_text(system.variable(to).items)),
             "map such values in an <ssc:IntegerMappingTransformation> at the connection");
  }
}

void ItemCheck::add(VariableId id, const ValueSlice& value) {
  const Variable& variable = system_.variable(id);
  if (!has_items(variable)) return;
  const auto numbers = value.block->numbers<std::int64_t>().subspan(value.first, value.size);
  for (const std::int64_t& number : numbers) {
    values_.push_back({id, &number, ItemSet(variable.items)});
  }
}

void ItemCheck::fail(const Value& value, Time time) const {
  fail_item(system_, value.id, *value.number, time);
}

}  // namespace stride::core
