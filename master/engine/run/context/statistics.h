#ifndef STRIDE_MASTER_ENGINE_RUN_CONTEXT_STATISTICS_H
#define STRIDE_MASTER_ENGINE_RUN_CONTEXT_STATISTICS_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/port/capabilities/host_diagnostics.h"

namespace stride::core {

/// A unit that was to repeat steps, and has come to another value.
struct InexactRepetition {
  Time time{};
  std::string variable;       ///< empty if the steps ended otherwise
  std::string first, second;  ///< its value
};

struct UnitStatistics {
  std::uint64_t calls = 0;           ///< of its interface functions, where they are counted
  std::uint64_t steps = 0;           ///< including repeated ones
  std::uint64_t early_returns = 0;   ///< steps that returned before the target
  std::uint64_t rejections = 0;      ///< steps that it rejected
  std::uint64_t rollbacks = 0;       ///< steps of it that were undone, because another unit stopped
  std::uint64_t saves = 0;           ///< of its state
  std::uint64_t repeated_steps = 0;  ///< made to get from a saved state to where it was taken back
  std::optional<InexactRepetition> inexact_repetition{};  ///< the first one
  std::uint64_t events = 0;              ///< super-dense instants handled in Event Mode
  std::uint64_t unannounced_events = 0;  ///< at the end of a step that it did not end early
  std::uint64_t suspensions = 0;  ///< times that it was suspended, because it promised to be idle
  Duration suspended_time{};      ///< the simulated time of all of them
  Duration longest_suspension{};
  std::uint64_t messages_sent = 0;
  std::uint64_t messages_received = 0;
  std::chrono::nanoseconds
      initialization_time{};             ///< wall-clock time within the unit's own functions
  std::chrono::nanoseconds step_time{};  ///< likewise, its state saved and restored included
  std::chrono::nanoseconds event_time{};
  /// Standard deviations of these, which are estimates where not all steps were measured.
  std::chrono::nanoseconds step_time_uncertainty{}, event_time_uncertainty{};
  std::optional<HostStatistics> host{};  ///< of a hosted unit
};

/// Wall-clock time of a whole run.
struct PhaseTimes {
  std::chrono::nanoseconds initialization{};
  std::chrono::nanoseconds steps{};     ///< of all units, with inputs within steps and redone steps
  std::chrono::nanoseconds instants{};  ///< values exchanged and events handled between steps
  std::chrono::nanoseconds observers{};
};

/// How a run that did not fail ended.
enum class RunEnd : std::uint8_t {
  Completed,
  EndedByUnit,
  Interrupted,
  EndedEarly,  ///< by Simulation::end() before the stop time
};

class StateArchive;

/// As run.json has it: "ended by a unit".
const char* name(RunEnd end);

struct RunStatistics {
  Time start{};
  Time reached{};  ///< the last communication point
  std::uint64_t communication_steps = 0;
  std::uint64_t undone_steps = 0;  ///< of all units, since an input's error was too large
  std::uint64_t event_iterations = 0;
  std::uint64_t parallel_steps = 0;  ///< communication steps that were made on several threads
  /// Communication steps in which the times of units and phases were measured: a random sample,
  /// where measuring all would slow the run down. The times are scaled to all steps.
  std::uint64_t measured_steps = 0;
  std::chrono::nanoseconds wall_time{};
  PhaseTimes phases{};
  PhaseTimes phase_uncertainties{};  ///< standard deviations
  RunEnd end = RunEnd::Completed;
  std::vector<UnitStatistics> units;  ///< in the order of System::components()
};

/// What was counted and measured so far, of as many units: without what its parts keep themselves
/// (UnitCounters), and what is as in any run.
void persist(StateArchive& state, RunStatistics& statistics);

}  // namespace stride::core

#endif
