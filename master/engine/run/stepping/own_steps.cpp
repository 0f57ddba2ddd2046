#include "master/engine/run/stepping/own_steps.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/engine/model/system/own_step.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/run/stepping/input_extrapolator.h"

namespace stride::core {

OwnSteps::OwnSteps(RunContext& context, InputExtrapolator* inputs)
    : system_(context.system),
      units_(context.units),
      exchange_(context.exchange),
      statistics_(context.statistics.units),
      inputs_(inputs),
      start_(context.options.start),
      stop_(context.options.stop),
      minimum_(context.options.step.minimum.rounded()),
      states_(units_.size()) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Component& component = system_.components()[i];
    if (!component.own_step) continue;
    State& state = states_[i];
    state.grid.emplace(start_, *component.own_step);
    state.keeps = component.keeps_own_step();
    state.can_vary_step = component.description->can_vary_step;
    state.reached = state.before = start_;
    choose_due(state);
    with_step_.push_back(i);
    if (state.keeps) keeping_.push_back(i);
  }
}

bool OwnSteps::are_multiples_of(const Interval& size) const {
  return std::ranges::all_of(
      with_step_, [&](std::size_t i) { return states_[i].grid->step().is_multiple_of(size); });
}

Time OwnSteps::next(Time now) const {
  Time earliest = Time::max();
  for (const std::size_t i : with_step_) {
    const State& state = states_[i];
    earliest = std::min(earliest, state.keeps ? state.due : next_of_grid(state, now));
  }
  return earliest;
}

/// The stop time instead of a point that is as good as there.
Time OwnSteps::next_of_grid(const State& state, Time now) const {
  const Grid& grid = *state.grid;
  const std::uint64_t index = grid.index_at(now);
  const bool ends_there = stop_ > now && grid.is_regular(stop_ - grid.point(index));
  return ends_there ? stop_ : grid.point(index + 1);
}

Time OwnSteps::next_event_from(std::size_t component, Time time) const {
  const State& state = states_[component];
  if (!state.keeps || state.can_vary_step) return time;
  return state.grid->has(time) ? time : next_of_grid(state, time);
}

void OwnSteps::choose_due(State& state) const {
  state.due = next_of_grid(state, state.reached);
  if (state.event && *state.event > state.reached) state.due = std::min(state.due, *state.event);
  if (state.can_vary_step && state.reached < stop_) state.due = std::min(state.due, stop_);
}

void OwnSteps::set_event(std::size_t component, const std::optional<Time>& event) {
  State& state = states_[component];
  state.event = event;
  if (state.keeps) choose_due(state);
}

void OwnSteps::hold_inputs(std::size_t component, Time from) {
  if (inputs_ == nullptr && reached(component) == from) {
    exchange_.write_routed_inputs(component, *units_[component]);
  }
}

StepInterval OwnSteps::interval(std::size_t component, Time to) const {
  const Grid& grid = *states_[component].grid;
  const Time from = reached(component);
  return {from, grid.seconds(from), to, grid.seconds(to), grid.seconds(to - from)};
}

StepResult OwnSteps::step(std::size_t component, Time to) {
  check_size(component, to);
  const StepInterval step = interval(component, to);
  Unit& unit = *units_[component];
  if (inputs_ == nullptr) {
    return step_rest(component, step, exchange_.step_with_held_inputs(component, unit, step));
  }
  inputs_->before_step(component, step);
  return step_rest(component, step, exchange_.step(component, unit, step));
}

void OwnSteps::begin_step(std::size_t component, Time to, ConcurrentSteps& steps,
                          const ConcurrentSteps::Extras& extras) {
  check_size(component, to);
  const StepInterval step = interval(component, to);
  if (inputs_ == nullptr) {
    return exchange_.begin_step_with_held_inputs(component, steps, step, extras);
  }
  inputs_->before_step(component, step);
  exchange_.begin_step(component, *units_[component], steps, step, extras);
}

StepResult OwnSteps::finish_step(std::size_t component, Time to, const StepResult& result) {
  return step_rest(component, interval(component, to), result);
}

/// Behind the first attempt, `step`: up to its end, unless the unit ends the simulation.
StepResult OwnSteps::step_rest(std::size_t component, StepInterval step, StepResult result) {
  State& state = states_[component];
  const Time end = step.to;
  while (result.rejected || (result.reached != end && !result.terminate_simulation)) {
    const bool is_whole = !result.rejected && result.reached == step.to;
    if (!is_whole && !state.can_vary_step) fail_rejected(component, step);
    statistics_[component].rejections += result.rejected;
    statistics_[component].early_returns += !result.rejected && !is_whole;
    state.steps += !result.rejected;
    step = result.rejected ? StepInterval(step.from, retry_target(component, step, result))
                           : StepInterval(result.reached, end);
    result = exchange_.step_with_held_inputs(component, *units_[component], step);
  }
  ++state.steps;
  state.before = state.reached;
  state.reached = result.reached = end;
  choose_due(state);
  return result;
}

Time OwnSteps::retry_target(std::size_t component, const StepInterval& step,
                            const StepResult& result) const {
  const bool is_said = step.from < result.reached && result.reached < step.to;
  const Time target = is_said ? result.reached : step.from + (step.to - step.from) / 2;
  if (target - step.from >= minimum_ && target > step.from) return target;
  fail_run({{}, system_.components()[component].name, {}, step.from},
           fmt::format("the unit rejected the step to {} s, and the next one to try, to {} s, "
                       "would be shorter than the minimum of {} s{}",
                       to_text(step.to), to_text(target), to_text(minimum_), reason(component)),
           "look at what the unit received before this instant");
}

void OwnSteps::undo(std::size_t component) {
  State& state = states_[component];
  state.reached = state.before;
  choose_due(state);
}

/// With inputs that are set in steps, those of this instant are there again behind it.
StepResult OwnSteps::catch_up(std::size_t component, Time time) {
  const StepResult result = step(component, time);
  if (inputs_ != nullptr) exchange_.route(time);
  return result;
}

void OwnSteps::catch_up_all(Time time) {
  for (const std::size_t i : keeping_) {
    if (is_behind(i, time) && !must_wait(i, time)) catch_up(i, time);
  }
}

void OwnSteps::persist(StateArchive& state, Time start, Time now) {
  if (is_trivial()) return;
  state.mark("own steps");
  state.fixed(keeping_, [&](std::size_t i) {
    State& unit = states_[i];
    state.value(unit.reached);
    state.value(unit.steps);
    if (unit.reached < start || unit.reached > now) state.fail("a unit is not where it can be");
    choose_due(unit);
    if (unit.due <= now) state.fail("a unit's own step is over");
  });
}

/// A unit that takes steps of one size only can only go from point to point.
void OwnSteps::check_size(std::size_t component, Time to) const {
  const State& state = states_[component];
  const Time end = next_of_grid(state, state.reached);
  if (state.can_vary_step || to == end) return;
  fail_run({{}, system_.components()[component].name, {}, to},
           fmt::format("the unit takes steps of one size only, {} s, and its present one ends at "
                       "{} s, but it has an event here",
                       to_text(state.grid->step()), to_text(end)),
           "use a unit with canHandleVariableCommunicationStepSize, or let events that concern the "
           "unit fall on its steps");
}

/// The unit's reason for it.
std::string OwnSteps::reason(std::size_t component) const {
  auto* const diagnostics = units_[component]->capability<UnitDiagnostics>();
  const std::string text = diagnostics != nullptr ? diagnostics->rejection_reason() : "";
  return text.empty() ? "" : "; message of the unit: " + text;
}

void OwnSteps::fail_rejected(std::size_t component, const StepInterval& step) const {
  const Component& rejecting = system_.components()[component];
  const std::string hint =
      own_step_hint(rejecting.name, *rejecting.description, states_[component].grid->step());
  fail_run({{}, rejecting.name, {}, step.from},
           fmt::format("the unit rejected its step, and takes steps of one size only, {} s, so no "
                       "shorter one can be tried{}",
                       to_text(states_[component].grid->step()), reason(component)),
           hint.empty() ? "look at what the unit received before this instant" : hint);
}

}  // namespace stride::core
