// The state of the exchange at a communication point.
#include <cstdint>

#include "master/algorithm/exchange/exchange.h"
#include "master/util/state_archive.h"

namespace stride::core {

void Exchange::persist(StateArchive& state) {
  state.mark("exchange");
  for (Transfers* const outputs : {&outputs_, &sampled_outputs_}) {
    for (std::vector<Transfer>& transfers : *outputs) {
      state.fixed(transfers, [&](Transfer& output) { core::persist(state, output.block); });
    }
  }
  for (Transfers* const inputs : {&inputs_, &sampled_inputs_}) {
    for (std::vector<Transfer>& transfers : *inputs) {
      state.fixed(transfers, [&](Transfer& input) { persist(state, input); });
    }
  }
  state.fixed(ports_, [&](Port& port) {
    bool is_written = port.written_route == route_;
    state.value(is_written);
    if (state.is_reading()) port.written_route = is_written ? route_ : 0;
  });
  persist_forced(state);
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
