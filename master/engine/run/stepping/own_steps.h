// Components with steps of their own.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_OWN_STEPS_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_OWN_STEPS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/time/grid.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/stepping/own_progress.h"

namespace stride::core {

class InputExtrapolator;
class StateArchive;

/// Steps the components that keep steps of their own (Component::keeps_own_step()), from a point of
/// their grid to the next one, and adds the grids of all own steps to the communication points.
/// Such a component is called at the end of its step, with the inputs that it was given at the
/// beginning, so it has gone nowhere that others might have to come back from. Until then it is
/// behind the others, and its outputs hold. Where it has an event it is called for the part up to
/// there, if it can vary its step.
///
/// Inputs that are set in steps (RunOptions::sets_inputs_in_steps()) are those that are known where
/// it is called.
///
/// A function for one component touches the state of that component only, so different threads may
/// call it for different components.
class OwnSteps final : public OwnProgress {
 public:
  /// Both must outlive this object. `inputs` sets the inputs before each step; null if they hold.
  OwnSteps(RunContext& context, InputExtrapolator* inputs);

  /// Whether no component has a step of its own.
  bool is_trivial() const { return with_step_.empty(); }
  bool keeps(std::size_t component) const override { return states_[component].keeps; }
  /// How many components keep one.
  std::size_t count() const { return keeping_.size(); }
  /// Whether each of their points is one of a grid of this size.
  bool are_multiples_of(const Interval& size) const;

  /// The earliest point later than `now`, a communication point.
  Time next(Time now) const;
  Time reached(std::size_t component) const override { return states_[component].reached; }
  /// The first instant not before `time` at which it can have an event: one that takes steps of one
  /// size only is at its own points only.
  Time next_event_from(std::size_t component, Time time) const;
  bool must_wait(std::size_t component, Time now) const {
    return next_event_from(component, now) != now;
  }
  /// Whether its present step ends later than that.
  bool waits(std::size_t component, Time until) const { return until < states_[component].due; }
  /// How many it has made.
  std::uint64_t steps(std::size_t component) const { return states_[component].steps; }

  /// The unit has announced an event, or none, up to which it has to be stepped.
  void set_event(std::size_t component, const std::optional<Time>& event);

  /// Before a step of the others from this time on: where its own begins here, it gets its inputs.
  void hold_inputs(std::size_t component, Time from);
  /// Makes its step, or the part of it, to this time, and reads its outputs. Where the unit rejects
  /// the step or ends it early, it makes several. Throws Error (Run) where it cannot.
  StepResult step(std::size_t component, Time to);
  /// The same of a unit that steps elsewhere.
  void begin_step(std::size_t component, Time to, ConcurrentSteps& steps,
                  const ConcurrentSteps::Extras& extras);
  StepResult finish_step(std::size_t component, Time to, const StepResult& result);
  /// The last step is undone.
  void undo(std::size_t component);

  /// At an event: steps the component, which is behind, to this time.
  StepResult catch_up(std::size_t component, Time time);
  /// At the end of the run: those that can.
  void catch_up_all(Time time);

  /// At the communication point `now`, after its events.
  void persist(StateArchive& state, Time start, Time now);

 private:
  struct State {
    std::optional<Grid> grid{};
    bool keeps = false;
    bool can_vary_step = true;
    Time reached{};
    Time before{};  ///< what it had reached before its last step
    Time due{};
    std::optional<Time> event{};
    std::uint64_t steps = 0;
  };

  Time next_of_grid(const State& state, Time now) const;
  void choose_due(State& state) const;
  StepInterval interval(std::size_t component, Time to) const;
  StepResult step_rest(std::size_t component, StepInterval step, StepResult result);
  Time retry_target(std::size_t component, const StepInterval& step,
                    const StepResult& result) const;
  void check_size(std::size_t component, Time to) const;
  std::string reason(std::size_t component) const;
  [[noreturn]] void fail_rejected(std::size_t component, const StepInterval& step) const;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  std::vector<UnitStatistics>& statistics_;
  InputExtrapolator* inputs_;
  Time start_, stop_;
  Duration minimum_;                    ///< no shorter step is tried after a rejection
  std::vector<State> states_;           ///< by component
  std::vector<std::size_t> with_step_;  ///< components that have a step of their own
  std::vector<std::size_t> keeping_;    ///< those of them that keep it
};

}  // namespace stride::core

#endif
