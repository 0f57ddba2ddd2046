#include "master/core/stepper.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::core {
namespace {

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

std::vector<std::span<const StepPlace>> stages_of(std::span<const StepPlace> order) {
  std::vector<std::span<const StepPlace>> stages;
  for (std::size_t first = 0, i = 0; i < order.size(); ++i) {
    if (i + 1 < order.size() && order[i + 1].stage == order[i].stage) continue;
    stages.push_back(order.subspan(first, i + 1 - first));
    first = i + 1;
  }
  return stages;
}

}  // namespace

Stepper::Stepper(const System& system, std::span<const std::unique_ptr<Unit>> units,
                 std::vector<UnitStatistics>& statistics, WallClock clock,
                 const RunOptions& options, StepInputs* inputs)
    : system_(system),
      units_(units),
      statistics_(statistics),
      clock_(clock),
      step_clock_(clock),
      inputs_(inputs),
      regular_(options.step.size),
      minimum_(options.step.minimum),
      order_(step_order(system, options.step.policy, options.coupling)),
      stages_(stages_of(order_)),
      progress_(units.size()),
      split_(plan(options)) {}

WorkSplit::Plan Stepper::plan(const RunOptions& options) {
  WorkSplit::Plan plan;
  plan.threads = options.coupling == Coupling::GaussSeidel ? 1 : options.threads.count;
  plan.always = options.threads.always;
  if (!plan.always) {
    plan.threads = std::min<std::size_t>(plan.threads, std::thread::hardware_concurrency());
  }
  plan.threads = std::clamp<std::size_t>(plan.threads, 1, std::max<std::size_t>(1, units_.size()));
  const auto& main_only = options.threads.main_only;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    plan.stages.resize(order_[i].stage + 1);
    plan.stages.back().push_back(i);
    plan.main_only.push_back(std::count(main_only.begin(), main_only.end(), order_[i].component) !=
                             0);
  }
  plan.hand_over = [this] { return pool().measure_hand_over(); };
  return plan;
}

ThreadPool& Stepper::pool() {
  if (!pool_) pool_.emplace(split_.threads());
  return *pool_;
}

Time Stepper::advance(Time from, Time target) {
  rejections_ = 0;
  for (Progress& unit : progress_) {
    unit.result = {.reached = from};
    unit.is_saved = false;
  }
  if (!split_.is_adaptive()) [[likely]]
    return make_passes(from, target);
  step_clock_ = WallClock(clock_.measures() || split_.is_measuring());
  const auto began = WallClock::Source::now();
  const Time reached = make_passes(from, target);
  split_.end_step(WallClock::Source::now() - began);
  return reached;
}

void Stepper::undo(Time from) {
  for (const StepPlace& place : order_) {
    roll_back(place.component, from);
    ++statistics_[place.component].rollbacks;
  }
}

Time Stepper::make_passes(Time from, Time target) {
  was_parallel_ = split_.is_parallel();
  while (true) {
    const Time reached = step_all(from, target);
    if (reached == target) return target;
    target = reached;
  }
}

/// One pass. Returns the target if all units stand there, else the nearer one for the next pass.
inline Time Stepper::step_all(Time from, Time target) {
  for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
    const Time reached = step_stage(stage, from, target);
    if (reached != target) return reached;
  }
  return target;
}

inline Time Stepper::step_stage(std::size_t stage, Time from, Time target) {
  const std::span<const WorkShare> shares = split_.shares(stage);
  if (!shares.empty()) step_on_threads(shares, from, target);
  Time reached = target;
  for (const StepPlace& place : stages_[stage]) {
    if (shares.empty()) step(place, from, target);
    const Time allowed = take_down(place, from, target);
    if (allowed >= reached) continue;
    reached = allowed;
    stopped_ = &place;
    stopped_at_ = progress_[place.component].result.reached;
  }
  if (reached != target) check_minimum(from, reached, target);
  return reached;
}

void Stepper::step_on_threads(std::span<const WorkShare> shares, Time from, Time target) {
  pool().run(shares.size(), [&](std::size_t k) noexcept {
    for (const std::size_t i : shares[k]) step(order_[i], from, target);
  });
}

/// May be called for different units at the same time.
void Stepper::step(const StepPlace& place, Time from, Time target) noexcept {
  Progress& unit = progress_[place.component];
  unit.saved = unit.rolled_back = false;
  unit.time = {};
  try {
    unit.outcome = step_clock_.timed(unit.time, [&] { return go(place, unit, from, target); });
    return;
  } catch (const ConsequentError&) {
    unit.failure = std::current_exception();
    unit.is_consequence = true;
  } catch (...) {
    unit.failure = std::current_exception();
  }
  unit.outcome = Outcome::Failed;
}

inline Stepper::Outcome Stepper::go(const StepPlace& place, Progress& unit, Time from,
                                    Time target) {
  Unit& instance = *units_[place.component];
  if (place.saves_state && !unit.is_saved) {
    instance.save_state();
    unit.is_saved = unit.saved = true;
  }
  if (unit.result.reached > target) {
    if (!place.saves_state) return Outcome::TooFar;
    roll_back(place.component, from);
    unit.rolled_back = true;
  }
  if (unit.result.reached == target) return Outcome::Stood;
  if (!place.can_vary_step && target - from != regular_) fail_size(place, from, target);
  if (inputs_ != nullptr) inputs_->before_step(place.component, instance, from, target);
  const StepResult result = instance.step(from, target);
  if (result.rejected) return Outcome::Rejected;
  unit.result = result;
  if (inputs_ != nullptr) inputs_->after_step(place.component, instance, result.reached);
  return Outcome::Stepped;
}

void Stepper::roll_back(std::size_t component, Time from) {
  units_[component]->restore_state();
  progress_[component].result = {.reached = from};
  if (inputs_ != nullptr) inputs_->undo_step(component);
}

/// Counts what the unit did, and returns how far it lets the others go.
inline Time Stepper::take_down(const StepPlace& place, Time from, Time target) {
  const Progress& unit = progress_[place.component];
  UnitStatistics& statistics = statistics_[place.component];
  if (place.saves_state) {
    statistics.saves += unit.saved;
    statistics.rollbacks += unit.rolled_back;
  }
  if (step_clock_.measures()) take_down_time(place, unit.time);
  switch (unit.outcome) {
    case Outcome::Stood:
      return target;
    case Outcome::Stepped:
      ++statistics.steps;
      if (unit.result.reached != target) ++statistics.early_returns;
      return unit.result.reached;
    case Outcome::Rejected:
      ++statistics.rejections;
      ++rejections_;
      return from + (target - from) / 2;
    case Outcome::TooFar:
      fail_final(place);
    case Outcome::Failed:
      break;
  }
  rethrow_failure(place);
}

void Stepper::take_down_time(const StepPlace& place, std::chrono::nanoseconds time) {
  if (clock_.measures()) statistics_[place.component].step_time += time;
  if (split_.is_measuring()) {
    split_.note_cost(static_cast<std::size_t>(&place - order_.data()), time);
  }
}

/// The first failure in the step order that is no mere consequence of another one.
void Stepper::rethrow_failure(const StepPlace& first) const {
  for (const StepPlace& place : stages_[first.stage]) {
    const Progress& unit = progress_[place.component];
    if (unit.outcome == Outcome::Failed && !unit.is_consequence) {
      std::rethrow_exception(unit.failure);
    }
  }
  std::rethrow_exception(progress_[first.component].failure);
}

void Stepper::check_minimum(Time from, Time reached, Time target) const {
  const bool is_large_enough = reached - from >= minimum_ && reached > from;
  if (is_large_enough || progress_[stopped_->component].outcome != Outcome::Rejected) return;
  const std::string reason = units_[stopped_->component]->rejection_reason();
  fail_run({{}, system_.components()[stopped_->component].name, {}, from},
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
  fail_run(
      {{}, system_.components()[stopped_->component].name, {}, stopped_at_},
      fmt::format("the unit stopped here, but '{}' is at {} s already and cannot be rolled back",
                  system_.components()[ahead.component].name,
                  to_text(progress_[ahead.component].result.reached)),
      "use a unit that can save its state in place of one of the two, or a smaller step");
}

}  // namespace stride::core
