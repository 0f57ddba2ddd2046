// Idle units: when they are suspended, and when they catch up.
#ifndef STRIDE_MASTER_ENGINE_RUN_IDLE_IDLE_SCHEDULER_H
#define STRIDE_MASTER_ENGINE_RUN_IDLE_IDLE_SCHEDULER_H

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/run/context/run_context.h"

namespace stride::core {

class StateArchive;

/// Suspends units that promise to be idle (org.stride.idle): they are not called, and their outputs
/// follow their tangents. The lag of such a unit is the time since its last step. The unit catches
/// up by one step over the lag, with the inputs of its suspension, before an input leaves its
/// deadband, before an event, and before the lag exceeds the promise or max_skip.
///
/// A function for one component touches the state of that component only, so different threads may
/// call it for different components.
class IdleScheduler {
 public:
  /// The context, with its RunOptions::idle, must outlive this object.
  explicit IdleScheduler(RunContext& context);

  /// Whether no unit of the system may be suspended.
  bool is_trivial() const { return candidates_.empty(); }

  /// Enables the promises of the units, before they enter Initialization Mode.
  void enable();

  bool may_suspend(std::size_t component) const { return states_[component].is_candidate; }
  bool is_suspended(std::size_t component) const { return states_[component].is_suspended; }
  /// Whether it is, and has been from an earlier instant than `time`, the current communication
  /// point, on.
  bool was_suspended(std::size_t component, Time time) const {
    return is_suspended(component) && states_[component].since < time;
  }
  /// Whether the unit, which is suspended, can stay so up to this time.
  bool covers(std::size_t component, Time time) const { return time <= states_[component].end; }
  /// Up to when no unit has to be called, but for those that keep their own steps: until a
  /// suspension ends, or the tangent of an output takes an input out of its deadband. Nothing where
  /// another unit is not suspended. `time`: the current communication point, with all values
  /// exchanged.
  std::optional<Time> all_suspended_until(Time time) const;

  /// The simulated time of all suspensions up to `time`, the current communication point, including
  /// those that last.
  Duration suspended_time(Time time) const;

  /// Ends the suspension of the unit: steps it to `time` and reads its outputs. Returns whether
  /// it has an event there, which is allowed where its promise ends. Throws Error (Run) with unit,
  /// time and promise where the unit does not keep its promise.
  bool catch_up(std::size_t component, Time time);
  /// Reports the suspension that catch_up() has ended, on the thread of the simulation.
  void report_suspension(std::size_t component);
  /// Both, on the thread of the simulation.
  bool catch_up_and_report(std::size_t component, Time time);

  /// At the communication point `time`: moves the outputs of the suspended units along their
  /// tangents. Units whose suspension ends here catch up; returns those of them that have an event.
  std::span<const std::size_t> advance_to(Time time);
  /// After the exchange: lets the suspended units catch up that have a discrete change at an input,
  /// or an input outside of its deadband. Returns whether outputs may have changed by that.
  bool catch_up_disturbed(Time time);
  /// After the events of a communication point: writes the inputs of the units that are not
  /// suspended, reads their promises, and suspends those whose promise is long enough.
  void suspend_idle(Time time);
  /// At the communication point `now`, after suspend_idle(). The Exchange's state is persisted
  /// before.
  void persist(StateArchive& state, Time start, Time now);
  /// After a state was read, and Exchange::read_new_outputs(): suspended units get the tangents of
  /// their new outputs.
  void take_new_tangents(Time now);
  /// At the end of the run.
  void catch_up_all(Time time);
  /// Reports the suspensions that a failure at `time` has ended.
  void report_unfinished(Time time);

 private:
  struct Tangent {
    VariableId id;
    ValueSlice element;
    double value = 0;
    double slope = 0;

    void begin(double its_slope) {
      value = real(element);
      slope = its_slope;
    }
    void follow(double elapsed) const { set_real(element, value + slope * elapsed); }
  };
  struct WatchedInput {
    ValueSlice element;
    double deadband = 0;
    double held = 0;                  ///< its value when the unit was suspended
    const Tangent* source = nullptr;  ///< of the output that feeds it, if that has one
    double factor = 1;                ///< of the connection
  };
  struct IdleState {
    bool is_candidate = false;
    IdlePromises* promises = nullptr;  ///< of a candidate
    bool is_suspended = false;
    Time since{};                        ///< the last time that the unit has reached
    Time until{};                        ///< the promise
    Time end{};                          ///< of the suspension, at the latest
    std::optional<Time> unreported_end;  ///< its actual end, until it is reported
    Duration max_skip{};
    std::vector<WatchedInput> inputs;
    std::vector<Tangent> tangents;
    std::vector<ValueReference> references;  ///< of the outputs with tangents
    std::vector<double> slopes;              ///< of their elements
  };

  void persist(StateArchive& state, std::size_t component, Time start, Time now);
  void persist_tangents(StateArchive& state, std::size_t component);
  static void persist(StateArchive& state, Tangent& tangent);
  static void drop_tangents(StateArchive& state, const Variable& output);
  void take_new_tangents(std::size_t component, Time now);
  void add_candidate(std::size_t component, Duration max_skip);
  void find_sources();
  static Time leaves_deadband(const WatchedInput& input, Time time);
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
  bool are_others_own_ = true;  ///< all others keep their own steps
  std::vector<std::size_t> events_;
};

}  // namespace stride::core

#endif
