#include "master/core/stepper.h"

#include <fmt/format.h>

namespace stride::core {
namespace {

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

Stepper::Stepper(const System& system, std::span<const std::unique_ptr<Unit>> units,
                 std::vector<UnitStatistics>& statistics, WallClock clock,
                 const RunOptions& options, StepInputs* inputs)
    : system_(system),
      units_(units),
      statistics_(statistics),
      clock_(clock),
      inputs_(inputs),
      regular_(options.step.size),
      minimum_(options.step.minimum),
      order_(step_order(system, options.step.policy, options.coupling)),
      results_(units.size()) {}

Time Stepper::advance(Time from, Time target) {
  rejections_ = 0;
  save(from);
  while (true) {
    const Time reached = step_all(from, target);
    if (reached == target) return target;
    target = reached;
  }
}

void Stepper::undo(Time from) {
  for (const StepPlace& place : order_) roll_back(place, from);
}

void Stepper::save(Time from) {
  for (const StepPlace& place : order_) {
    results_[place.component] = {.reached = from};
    if (!place.saves_state) continue;
    units_[place.component]->save_state();
    ++statistics_[place.component].saves;
  }
}

/// One pass. Returns the target if all units stand there, else the nearest instant at which one of
/// them stopped, for the next pass. All that can go back are asked for the same target, so that
/// their order changes nothing; the others only once these agree.
Time Stepper::step_all(Time from, Time target) {
  Time nearest = target;
  for (const StepPlace& place : order_) {
    if (nearest < target && place.role != StepRole::CanRollBack) break;
    const Time reached = step_one(place, from, target);
    if (reached >= nearest) continue;
    nearest = reached;
    stopped_ = &place;
  }
  return nearest;
}

/// Where the unit stands then, or, if it rejects the step, half the way.
Time Stepper::step_one(const StepPlace& place, Time from, Time target) {
  const StepResult& result = results_[place.component];
  if (result.reached > target) roll_back(place, from);
  if (result.reached == target) return target;
  if (!step(place, from, target)) return shortened(place, from, target);
  if (result.reached < target) ++statistics_[place.component].early_returns;
  return result.reached;
}

/// Returns whether the unit made a step, of whatever size.
bool Stepper::step(const StepPlace& place, Time from, Time target) {
  const std::size_t i = place.component;
  if (!place.can_vary_step && target - from != regular_) fail_size(place, from, target);
  if (inputs_ != nullptr) inputs_->before_step(i, *units_[i], from, target);
  const StepResult result =
      clock_.timed(statistics_[i].step_time, [&] { return units_[i]->step(from, target); });
  if (result.rejected) return false;
  ++statistics_[i].steps;
  results_[i] = result;
  if (inputs_ != nullptr) inputs_->after_step(i, *units_[i], result.reached);
  return true;
}

void Stepper::roll_back(const StepPlace& place, Time from) {
  if (!place.saves_state) fail_final(place);
  units_[place.component]->restore_state();
  ++statistics_[place.component].rollbacks;
  results_[place.component] = {.reached = from};
  if (inputs_ != nullptr) inputs_->undo_step(place.component);
}

Time Stepper::shortened(const StepPlace& place, Time from, Time target) {
  ++rejections_;
  ++statistics_[place.component].rejections;
  const Time nearer = from + (target - from) / 2;
  if (nearer - from >= minimum_ && nearer > from) return nearer;
  const std::string reason = units_[place.component]->rejection_reason();
  fail_run({{}, system_.components()[place.component].name, {}, from},
           fmt::format("the unit rejected the step to {} s, {} in all, and half of it would be "
                       "shorter than the minimum of "
                       "{} s{}{}",
                       to_text(target), times(rejections_), to_text(Time(minimum_)),
                       reason.empty() ? "" : "; it says: ", reason),
           "look at what the unit received before this instant");
}

void Stepper::fail_size(const StepPlace& place, Time from, Time target) const {
  fail_run(
      {{}, system_.components()[place.component].name, {}, from},
      fmt::format(
          "the unit takes steps of one size only, {} s, but another unit's event or stop asks for "
          "one of {} s",
          to_text(Time(regular_)), to_text(Time(target - from))),
      "use a unit with canHandleVariableCommunicationStepSize, or none that has events or stops "
      "early");
}

void Stepper::fail_final(const StepPlace& ahead) const {
  const StepResult& reached = results_[ahead.component];
  const StepResult& stopped = results_[stopped_->component];
  fail_run(
      {{}, system_.components()[stopped_->component].name, {}, stopped.reached},
      fmt::format("the unit stopped here, but '{}' is at {} s already and cannot be rolled back",
                  system_.components()[ahead.component].name, to_text(reached.reached)),
      "use a unit that can save its state in place of one of the two, or a smaller step");
}

}  // namespace stride::core
