#include "master/engine/run/exchange/item_check.h"

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <string>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/engine/model/item_text.h"
#include "master/engine/model/time/grid.h"

namespace stride::core {
namespace {

struct Mistake {
  Context context;
  std::string message, hint;
};

Mistake item_mistake(const System& system, VariableId id, std::int64_t number, Time time) {
  return {{{}, system.components()[id.component].name, system.variable(id).name, time},
          fmt::format("the unit gives {}, which is not an item of its Enumeration: {}", number,
                      item_text(system.variable(id).items)),
          "the unit must give one of its items, or its description must list this one"};
}

bool has_items(const Variable& variable) {
  return variable.type == ValueType::Enumeration && !variable.items.empty();
}

}  // namespace

bool FirstValues::is_before_first_step(std::size_t component, Time time) const {
  const Component& unit = system_.components()[component];
  return time <= start_ || (unit.keeps_own_step() && time < Grid(start_, *unit.own_step).point(1));
}

void FirstValues::refuse(VariableId from, const Context& context, const std::string& message,
                         const std::string& hint) const {
  if (!warn_ || !is_before_first_step(from.component, context.time.value_or(Time::max()))) {
    fail_run(context, message, hint);
  }
  if (!said_.insert(from).second) return;
  warn_(to_text(context) + message + "; it is passed on as it is until the unit's first step");
}

void check_items(const System& system, VariableId id, const ValueBlock& value, Time time) {
  const Variable& variable = system.variable(id);
  if (!has_items(variable)) return;
  const auto items = variable.items | std::views::values;
  for (const std::int64_t number : value.numbers<std::int64_t>()) {
    if (std::ranges::find(items, number) != items.end()) continue;
    const auto [context, message, hint] = item_mistake(system, id, number, time);
    fail_run(context, message, hint);
  }
}

void check_valid(const System& system, VariableId from, VariableId to,
                 std::span<const std::int64_t> valid, const ValueSlice& value, Time time,
                 const FirstValues* first) {
  const FirstValues others(system, Time::max());
  const auto numbers = value.block->numbers<std::int64_t>().subspan(value.first, value.size);
  for (const std::int64_t number : numbers) {
    if (std::ranges::binary_search(valid, number)) [[likely]]
      continue;
    const std::string unit = system.is_output(to) ? "" : system.components()[to.component].name;
    (first != nullptr ? *first : others)
        .refuse(from, {{}, unit, system.variable(to).name, time},
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
  const auto [context, message, hint] = item_mistake(system_, value.id, *value.number, time);
  first_.refuse(value.id, context, message, hint);
}

}  // namespace stride::core
