// The state of the exchange at a communication point.
#include <algorithm>
#include <cstdint>
#include <iterator>

#include "master/base/state_archive.h"
#include "master/engine/run/exchange/exchange.h"

namespace stride::core {

void Exchange::persist(StateArchive& state) {
  state.mark("exchange");
  new_outputs_.clear();
  for (std::size_t i = 0; i < outputs_.size(); ++i) persist_outputs(state, i);
  check_new_outputs(state);
  for (Transfers* const inputs : {&inputs_, &sampled_inputs_}) {
    for (std::vector<Transfer>& transfers : *inputs) {
      state.fixed(transfers, [&](Transfer& input) { persist(state, input); });
    }
  }
  state.fixed(ports_, [&](Port& port) {
    bool is_written = port.written_route == route_;
    state.value(is_written);
    if (!state.is_reading()) return;
    port.written_route = is_written ? route_ : 0;
    if (is_written) written_alone_ = route_;
  });
  persist_forced(state);
}

/// Each is found by its variable, since the run that reads them may observe others.
void Exchange::persist_outputs(StateArchive& state, std::size_t component) {
  const std::vector<std::uint64_t> own = output_keys(component);
  std::vector<std::uint64_t> keys = own;
  state.keys(keys, system_.components()[component].description->variables.size());
  for (const std::uint64_t key : keys) persist_output(state, {component, key});
  for (const std::uint64_t key : own) {
    if (!std::ranges::binary_search(keys, key)) new_outputs_.push_back({component, key});
  }
}

std::vector<std::uint64_t> Exchange::output_keys(std::size_t component) const {
  std::vector<std::uint64_t> keys;
  for (const Transfers* const outputs : {&outputs_, &sampled_outputs_}) {
    for (const Transfer& transfer : (*outputs)[component]) {
      for (const VariableId id : transfer.ids) keys.push_back(id.variable);
    }
  }
  std::ranges::sort(keys);
  return keys;
}

/// One that is not read any more is dropped.
void Exchange::persist_output(StateArchive& state, VariableId id) {
  if (!system_.is_signal(id) || locate_input(id).transfer != nullptr) {
    state.fail("what was read is no output");
  }
  const Variable& variable = system_.variable(id);
  ValueBlock value(variable.type, variable.size);
  const TransferSlot slot = locate_output(id);
  if (slot.transfer == nullptr) return core::persist(state, value);
  const ValueSlice place{&slot.transfer->block, slot.first, variable.size};
  const ValueSlice copy{&value, 0, variable.size};
  copy_elements(copy, place);
  core::persist(state, value);
  copy_elements(place, copy);
}

void Exchange::check_new_outputs(StateArchive& state) const {
  for (const Connection& connection : system_.connections()) {
    if (!std::ranges::binary_search(new_outputs_, connection.from)) continue;
    state.fail("it does not have an output that is connected");
  }
}

void Exchange::read_new_outputs(std::size_t component, Unit& unit) {
  for (const Transfers* const outputs : {&outputs_, &sampled_outputs_}) {
    for (const Transfer& transfer : (*outputs)[component]) read_new_outputs(transfer, unit);
  }
}

void Exchange::read_new_outputs(const Transfer& transfer, Unit& unit) {
  std::vector<VariableId> ids;
  std::ranges::set_intersection(transfer.ids, new_outputs_, std::back_inserter(ids));
  if (ids.empty()) return;
  std::vector<ValueReference> references;
  std::size_t size = 0;
  for (const VariableId id : ids) {
    references.push_back(system_.variable(id).reference);
    size += system_.variable(id).size;
  }
  ValueBlock values(transfer.block.type(), size);
  unit.get(references, values);
  std::size_t first = 0;
  for (const VariableId id : ids) {
    const ValueSlice place = slice(id);
    copy_elements(place, {&values, first, place.size});
    first += place.size;
  }
}

/// What was written is known of inputs that are written where they changed.
void Exchange::persist(StateArchive& state, Transfer& input) {
  core::persist(state, input.block);
  if (!input.is_discrete() && input.clocks.empty()) return;
  state.value(input.is_new);
  core::persist(state, input.written);
}

/// What is forced has its value in its block.
void Exchange::persist_forced(StateArchive& state) {
  std::uint64_t count = forced_.size();
  state.value(count);
  if (state.is_reading()) forced_.clear();
  for (std::uint64_t i = 0; i < count; ++i) {
    VariableId input = state.is_reading() ? VariableId{} : forced_[i].input;
    state.value(input.component);
    state.value(input.variable);
    if (state.is_reading()) {
      const bool is_connected = !system_.connections_to(input).empty();
      if (!is_connected || locate_input(input).transfer == nullptr) {
        state.fail("what is forced is no connected input");
      }
      forced_.push_back({input, slice(input), value(input)});
    }
  }
}

}  // namespace stride::core
