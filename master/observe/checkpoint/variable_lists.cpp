#include "master/observe/checkpoint/variable_lists.h"

#include <algorithm>

namespace stride::checkpoint {

bool VariableLists::is_of(Number number, std::span<const core::ValueReference> references,
                          core::ValueType type, std::size_t size) const {
  const VariableList& list = entries_[number].list;
  return list.type == type && list.size == size && std::ranges::equal(list.references, references);
}

VariableLists::Number VariableLists::find_or_add(std::span<const core::ValueReference> references,
                                                 core::ValueType type, std::size_t size) {
  Key key{type, size, {references.begin(), references.end()}};
  const auto [place, is_new] =
      numbers_.try_emplace(std::move(key), static_cast<Number>(entries_.size()));
  if (is_new) {
    entries_.push_back({.list = {.type = type, .references = place->first.references, .size = size},
                        .successor = place->second});
  }
  return place->second;
}

void VariableLists::persist(core::StateArchive& state, const core::UnitDescription& description) {
  state.mark("variables");
  if (state.is_reading()) *this = VariableLists();
  std::uint64_t count = entries_.size();
  state.value(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    VariableList list;
    if (!state.is_reading()) list = entries_[i].list;
    state.value(list.type, static_cast<core::ValueType>(core::kValueTypeCount - 1));
    std::uint64_t size = list.size;
    state.value(size);
    list.size = size;
    state.values(list.references);
    if (!state.is_reading()) continue;
    check(state, list, description);
    if (number_of(list.references, list.type, list.size) != i) state.fail("a list is there twice");
  }
  previous_ = 0;
}

void VariableLists::check(core::StateArchive& state, const VariableList& list,
                          const core::UnitDescription& description) {
  std::size_t size = 0;
  for (const core::ValueReference reference : list.references) {
    const auto found = description.find(reference);
    if (!found) state.fail("the unit does not have one of the variables");
    const core::Variable& variable = description.variables[*found];
    if (variable.type != list.type) state.fail("a variable is of another type");
    size += variable.size;
  }
  if (size != list.size) state.fail("variables have another number of elements");
}

}  // namespace stride::checkpoint
