// Idle units: who is left alone, and what that costs when somebody needs them again.
#ifndef STRIDE_MASTER_ALGORITHM_IDLE_IDLE_SCHEDULER_H
#define STRIDE_MASTER_ALGORITHM_IDLE_IDLE_SCHEDULER_H

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/capabilities/idle_promises.h"
#include "master/algorithm/run_context.h"

namespace stride::core {

/// A unit that promises to be idle (org.stride.idle) rests: it is not called. Meanwhile its outputs
/// go along their tangents, and its lag, the time since it was called last, grows. The lag is
/// paid, by one step over all of it with the inputs that the unit has had, before it is given other
/// inputs, handles an event, or goes past its promise or its max_skip.
///
/// Each function for one component concerns nothing of another, so different threads may call them
/// for different components.
class IdleScheduler {
 public:
  /// The context, with its RunOptions::idle, must outlive this object.
  explicit IdleScheduler(RunContext& context);

  /// Whether no unit of the system is ever to rest.
  bool is_trivial() const { return candidates_.empty(); }

  /// Before the units enter Initialization Mode: lets them skip and promise.
  void enable();

  bool may_suspend(std::size_t component) const { return states_[component].is_candidate; }
  bool is_suspended(std::size_t component) const { return states_[component].is_suspended; }
  /// Whether the unit, which rests, can do so up to this instant.
  bool covers(std::size_t component, Time time) const { return time <= states_[component].end; }
  /// How far the run may go without calling anybody; nothing where a unit does not rest.
  std::optional<Time> all_suspended_until() const;

  /// The simulated time of all rests up to `time`, where the run stands, those that last included.
  Duration suspended_time(Time time) const;

  /// The unit, which rests, is brought to `time`, and its outputs are fetched. Throws Error (Run)
  /// that names unit, time and promise where the unit does not keep it. Returns whether it has an
  /// event there, as it may where its promise ends.
  bool catch_up(std::size_t component, Time time);
  /// On the thread of the simulation, some time after catch_up(): tells of the rest that ended.
  void report_suspension(std::size_t component);
  /// Both at once, on that thread.
  bool catch_up_and_report(std::size_t component, Time time);

  /// All units stand at or owe up to `time`: the outputs of those that rest are what their tangents
  /// say, and those whose rests end here are woken. Returns those of them that have an event.
  std::span<const std::size_t> advance_to(Time time);
  /// After the exchange: wakes those of which an input has left its deadband. Returns whether
  /// outputs have changed by that.
  bool catch_up_disturbed(Time time);
  /// Between instants, where all inputs that are to be delivered have been: asks those that do not
  /// rest for promises.
  void suspend_idle(Time time);
  /// The run ends: all debts are paid.
  void catch_up_all(Time time);
  /// Tells of the rests that have not been told: a failure has ended them at `time`.
  void report_unfinished(Time time);

 private:
  struct WatchedInput {
    ValueSlice element;
    double deadband = 0;
    double held = 0;  ///< what the unit was given when it promised
  };
  struct Tangent {
    ValueSlice element;
    double value = 0;
    double slope = 0;
  };
  struct IdleState {
    bool is_candidate = false;
    IdlePromises* promises = nullptr;  ///< of a candidate
    bool is_suspended = false;
    Time since{};                        ///< where the unit stands
    Time until{};                        ///< its promise
    Time end{};                          ///< of the rest, at most
    std::optional<Time> unreported_end;  ///< where it did, if that is still to be told
    Duration max_skip{};
    std::vector<WatchedInput> inputs;
    std::vector<Tangent> tangents;
    std::vector<ValueReference> references;  ///< of the outputs with tangents
    std::vector<double> slopes;              ///< of their elements
  };

  void add_candidate(std::size_t component, Duration max_skip);
  void suspend(std::size_t component, Time time, Time until, Time end);
  bool is_disturbed(const IdleState& state) const;
  void check_promise(std::size_t component, Time time, const StepResult& result) const;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  std::vector<UnitStatistics>& statistics_;
  const Activities& activities_;
  const IdleOptions& options_;
  std::vector<IdleState> states_;  ///< by component
  std::vector<std::size_t> candidates_;
  std::vector<std::size_t> events_;
};

}  // namespace stride::core

#endif
