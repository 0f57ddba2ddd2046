#include "master/engine/run/context/statistics.h"

#include "master/base/state_archive.h"

namespace stride::core {
namespace {

/// So that more can be added to it.
template <class Length>
void persist_sum(StateArchive& state, Length& sum) {
  state.value(sum);
  if (sum < Length{} || sum > Length::max() / 2) state.fail("a length of time is impossible");
}

void persist_host(StateArchive& state, HostStatistics& host) {
  state.value(host.snapshots);
  state.value(host.restores);
  state.value(host.most_snapshots);
  state.value(host.most_snapshot_memory);
  state.value(host.most_memory);
}

void persist_unit(StateArchive& state, UnitStatistics& unit) {
  for (std::uint64_t* const count :
       {&unit.calls, &unit.early_returns, &unit.rejections, &unit.rollbacks, &unit.events,
        &unit.unannounced_events, &unit.suspensions, &unit.messages_sent,
        &unit.messages_received}) {
    state.value(*count);
  }
  persist_sum(state, unit.suspended_time);
  persist_sum(state, unit.longest_suspension);
  persist_sum(state, unit.initialization_time);
  persist_sum(state, unit.step_time);
  persist_sum(state, unit.event_time);
  persist_sum(state, unit.step_time_uncertainty);
  persist_sum(state, unit.event_time_uncertainty);
  state.optional(unit.host, [&](auto& host) { persist_host(state, host); });
}

void persist_phases(StateArchive& state, PhaseTimes& times) {
  persist_sum(state, times.initialization);
  persist_sum(state, times.steps);
  persist_sum(state, times.instants);
  persist_sum(state, times.observers);
}

}  // namespace

const char* name(RunEnd end) {
  switch (end) {
    case RunEnd::Completed:
      return "completed";
    case RunEnd::EndedByUnit:
      return "ended by a unit";
    case RunEnd::Interrupted:
      return "interrupted";
    case RunEnd::EndedEarly:
      return "ended early";
  }
  return "";
}

void persist(StateArchive& state, RunStatistics& statistics) {
  state.mark("statistics");
  for (std::uint64_t* const count :
       {&statistics.communication_steps, &statistics.undone_steps, &statistics.event_iterations,
        &statistics.parallel_steps, &statistics.measured_steps}) {
    state.value(*count);
  }
  persist_sum(state, statistics.wall_time);
  persist_phases(state, statistics.phases);
  persist_phases(state, statistics.phase_uncertainties);
  state.fixed(statistics.units, [&](UnitStatistics& unit) { persist_unit(state, unit); });
}

}  // namespace stride::core
