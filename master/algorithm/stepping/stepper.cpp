#include "master/algorithm/stepping/stepper.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/algorithm/capabilities/unit_diagnostics.h"

namespace stride::core {
namespace {

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

Stepper::Lane::Lane(Unit& stepped, const StepPlace& its_place)
    : unit(&stepped),
      place(&its_place),
      component(static_cast<std::uint32_t>(its_place.component)),
      saves_state(its_place.saves_state),
      can_vary_step(its_place.can_vary_step),
      state(saves_state ? &stepped.require_capability<StateSaving>() : nullptr) {}

Stepper::Stepper(const System& system, std::span<const std::unique_ptr<Unit>> units,
                 Exchange& exchange, std::vector<UnitStatistics>& statistics,
                 const Activities& activities, WallClock clock, const RunOptions& options,
                 StepInputs* inputs, IdleLedger* ledger)
    : system_(system),
      unit_count_(units.size()),
      exchange_(exchange),
      statistics_(statistics),
      activities_(activities),
      clock_(clock),
      step_clock_(clock),
      inputs_(inputs),
      ledger_(ledger),
      regular_(options.step.size),
      minimum_(options.step.minimum),
      order_(step_order(system, options.step.policy, options.coupling)),
      lane_of_(units.size()),
      times_(units.size()),
      failures_(units.size()),
      split_(plan(options)) {
  for (const StepPlace& place : order_) {
    lane_of_[place.component] = lanes_.size();
    Lane& lane = lanes_.emplace_back(*units[place.component], place);
    lane.may_rest = ledger != nullptr && ledger->may_rest(place.component);
    lane.is_plain =
        inputs == nullptr && !place.saves_state && place.can_vary_step && !lane.may_rest;
  }
  for (std::size_t first = 0, i = 0; i < order_.size(); ++i) {
    if (i + 1 < order_.size() && order_[i + 1].stage == order_[i].stage) continue;
    stages_.push_back(std::span(lanes_).subspan(first, i + 1 - first));
    first = i + 1;
  }
}

WorkSplit::Plan Stepper::plan(const RunOptions& options) {
  WorkSplit::Plan plan;
  plan.threads = options.coupling == Coupling::GaussSeidel ? 1 : options.threads.count;
  plan.always = options.threads.always;
  if (!plan.always) {
    plan.threads = std::min<std::size_t>(plan.threads, std::thread::hardware_concurrency());
  }
  plan.threads = std::clamp<std::size_t>(plan.threads, 1, std::max<std::size_t>(1, unit_count_));
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
  ++communication_step_;
  cut_ = {};
  has_requests_ = false;
  if (split_.is_deciding()) return make_timed_passes(from, target);
  const Time reached = make_passes(from, target);
  split_.end_step();
  return reached;
}

Time Stepper::make_timed_passes(Time from, Time target) {
  step_clock_ = WallClock(clock_.measures() || split_.is_measuring());
  const auto began = WallClock::Source::now();
  const Time reached = make_passes(from, target);
  split_.end_step(WallClock::Source::now() - began);
  step_clock_ = clock_;
  return reached;
}

void Stepper::undo(Time from) {
  for (Lane& lane : lanes_) {
    tell(lane, Activity::Kind::Undone, from, lane.result.reached);
    restore(lane, from);
    ++statistics_[lane.component].rollbacks;
  }
}

Time Stepper::make_passes(Time from, Time target) {
  was_parallel_ = split_.is_parallel();
  if (from != last_end_) last_end_seconds_ = to_seconds(from);
  const double from_seconds = last_end_seconds_;
  while (true) {
    const StepInterval interval(from, from_seconds, target);
    last_end_ = target;
    last_end_seconds_ = interval.end_seconds;
    const Time reached = step_all(interval);
    if (reached == target) return target;
    target = reached;
  }
}

/// One pass. Returns the target if all units stand there, else the nearer one for the next pass.
inline Time Stepper::step_all(const StepInterval& interval) {
  for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
    const Time reached = step_stage(stage, interval);
    if (reached != interval.to) return reached;
  }
  return interval.to;
}

inline Time Stepper::step_stage(std::size_t stage, const StepInterval& interval) {
  const std::span<const WorkShare> shares = split_.shares(stage);
  if (!shares.empty()) step_on_threads(shares, interval);
  const bool may_be_plain =
      shares.empty() && !step_clock_.measures() && interval.from != interval.to;
  Time reached = interval.to;
  for (Lane& lane : stages_[stage]) {
    const bool is_first = lane.communication_step != communication_step_;
    if (may_be_plain && lane.is_plain && is_first) [[likely]] {
      if (step_plainly(lane, interval)) continue;
    } else if (shares.empty()) {
      lane.outcome = go_timed(lane, interval);
    }
    const Time allowed = take_down(lane, interval);
    if (allowed >= reached) [[likely]]
      continue;
    reached = allowed;
    cut_ = {&lane, lane.result.reached, lane.outcome == Outcome::Rejected};
  }
  if (reached != interval.to) check_minimum(interval, reached);
  return reached;
}

void Stepper::step_on_threads(std::span<const WorkShare> shares, const StepInterval& interval) {
  pool().run(shares.size(), [&](std::size_t k) noexcept {
    for (const std::size_t i : shares[k]) step(lanes_[i], interval);
  });
}

/// May be called for different units at the same time.
void Stepper::step(Lane& lane, const StepInterval& interval) noexcept {
  try {
    lane.outcome = go_timed(lane, interval);
    return;
  } catch (const ConsequentError&) {
    failures_[index(lane)] = {std::current_exception(), true};
  } catch (...) {
    failures_[index(lane)] = {std::current_exception(), false};
  }
  lane.outcome = Outcome::Failed;
}

/// What go() comes down to for most units in most steps. Tells whether there is nothing to take
/// down.
inline bool Stepper::step_plainly(Lane& lane, const StepInterval& interval) {
  lane.communication_step = communication_step_;
  lane.rejections = 0;
  lane.result = exchange_.step(lane.component, *lane.unit, interval);
  lane.steps += !lane.result.rejected;
  if (lane.result.went_through(interval.to)) [[likely]]
    return true;
  lane.outcome = lane.result.rejected ? Outcome::Rejected : Outcome::Stepped;
  if (lane.result.rejected) {
    lane.possible = lane.result.reached;
    lane.result = {.reached = interval.from};
  }
  return false;
}

inline Stepper::Outcome Stepper::go_timed(Lane& lane, const StepInterval& interval) {
  return step_clock_.timed(times_[index(lane)], [&] { return go(lane, interval); });
}

inline Stepper::Outcome Stepper::go(Lane& lane, const StepInterval& interval) {
  lane.saved = lane.rolled_back = false;
  if (lane.may_rest && rests_on(lane, interval)) return Outcome::Stood;
  if (lane.communication_step != communication_step_) [[likely]] {
    lane.communication_step = communication_step_;
    lane.result = {.reached = interval.from};
    lane.rejections = 0;
    if (lane.saves_state) save(lane);
  } else if (lane.result.reached > interval.to) {
    if (!lane.saves_state) return Outcome::TooFar;
    go_back(lane, interval);
  }
  if (lane.result.reached == interval.to) return Outcome::Stood;
  if (!lane.can_vary_step && interval.to - interval.from != regular_) fail_size(lane, interval);
  if (inputs_ != nullptr) inputs_->before_step(lane.component, interval);
  const StepResult result = exchange_.step(lane.component, *lane.unit, interval);
  if (result.rejected) {
    lane.possible = result.reached;
    return Outcome::Rejected;
  }
  lane.result = result;
  ++lane.steps;
  if (inputs_ != nullptr) inputs_->after_step(lane.component, result.reached);
  return Outcome::Stepped;
}

/// Whether the unit rests and can be left alone up to the end of the step. If it cannot, it is
/// brought to where the step begins.
bool Stepper::rests_on(Lane& lane, const StepInterval& interval) {
  if (!ledger_->rests(lane.component)) return false;
  if (!ledger_->covers(lane.component, interval.to)) {
    ledger_->wake(lane.component, interval.from);
    return false;
  }
  lane.communication_step = communication_step_;
  lane.result = {.reached = interval.to};
  return true;
}

/// The inputs are part of the state.
void Stepper::save(Lane& lane) {
  exchange_.deliver_routed(lane.component, *lane.unit);
  lane.state->save_state();
  lane.saved = true;
}

void Stepper::go_back(Lane& lane, const StepInterval& interval) {
  lane.undone = lane.result.reached;
  restore(lane, interval.from);
  lane.rolled_back = true;
  if (interval.from == interval.to) exchange_.fetch(lane.component, *lane.unit);
}

void Stepper::restore(Lane& lane, Time from) {
  lane.state->restore_state();
  lane.result = {.reached = from};
  if (inputs_ != nullptr) inputs_->undo_step(lane.component);
}

/// Counts what the unit did, and returns how far it lets the others go.
inline Time Stepper::take_down(Lane& lane, const StepInterval& interval) {
  if (lane.may_rest) ledger_->tell_rest(lane.component);
  if (lane.saves_state) {
    UnitStatistics& statistics = statistics_[lane.component];
    statistics.saves += lane.saved;
    statistics.rollbacks += lane.rolled_back;
    if (lane.rolled_back) tell(lane, Activity::Kind::Undone, interval.from, lane.undone);
  }
  if (step_clock_.measures()) take_down_time(lane);
  switch (lane.outcome) {
    case Outcome::Stood:
      return interval.to;
    case Outcome::Stepped:
      has_requests_ |= lane.result.event_needed || lane.result.terminate;
      if (lane.result.reached != interval.to) {
        ++statistics_[lane.component].early_returns;
        tell(lane, Activity::Kind::EarlyReturn, interval.from, lane.result.reached);
      }
      return lane.result.reached;
    case Outcome::Rejected:
      ++statistics_[lane.component].rejections;
      ++lane.rejections;
      tell(lane, Activity::Kind::Rejection, interval.from, interval.to);
      return retry_target(lane, interval);
    case Outcome::TooFar:
      fail_final(lane);
    case Outcome::Failed:
      break;
  }
  rethrow_failure(lane);
}

/// Where the unit that rejected the step may come to.
Time Stepper::retry_target(const Lane& lane, const StepInterval& interval) {
  const bool is_said = interval.from < lane.possible && lane.possible < interval.to;
  return is_said ? lane.possible : interval.from + (interval.to - interval.from) / 2;
}

void Stepper::take_down_time(const Lane& lane) {
  const std::chrono::nanoseconds time = std::exchange(times_[index(lane)], {});
  if (clock_.measures()) statistics_[lane.component].step_time += time;
  if (split_.is_measuring()) split_.note_cost(index(lane), time);
}

/// The first failure in the step order that is no mere consequence of another one.
void Stepper::rethrow_failure(const Lane& first) const {
  for (const Lane& lane : stages_[first.place->stage]) {
    const Failure& failure = failures_[index(lane)];
    if (lane.outcome == Outcome::Failed && !failure.is_consequence) {
      std::rethrow_exception(failure.cause);
    }
  }
  std::rethrow_exception(failures_[index(first)].cause);
}

const std::string& Stepper::name(const Lane& lane) const {
  return system_.components()[lane.component].name;
}

void Stepper::check_minimum(const StepInterval& interval, Time reached) const {
  const bool is_large_enough = reached - interval.from >= minimum_ && reached > interval.from;
  if (is_large_enough || !cut_.is_rejection) return;
  fail_run({{}, name(*cut_.by), {}, interval.from},
           fmt::format("the unit rejected the step to {} s, {} in all, and the next one to try, to "
                       "{} s, would be shorter than the minimum of {} s{}",
                       to_text(interval.to), times(cut_.by->rejections), to_text(reached),
                       to_text(Time(minimum_)), reason(cut_)),
           "look at what the unit received before this instant");
}

/// What the unit says of a step that it rejected.
std::string Stepper::reason(const Cut& cut) const {
  auto* const unit = cut.is_rejection ? cut.by->unit->capability<UnitDiagnostics>() : nullptr;
  const std::string said = unit != nullptr ? unit->rejection_reason() : "";
  return said.empty() ? "" : "; it says: " + said;
}

void Stepper::fail_size(const Lane& lane, const StepInterval& interval) const {
  const std::string hint =
      "use a unit with canHandleVariableCommunicationStepSize, or none that has events or stops "
      "early";
  if (cut_.by == &lane) {
    fail_run({{}, name(lane), {}, interval.from},
             fmt::format("the unit rejected its step, and takes steps of one size only, {} s, so "
                         "no shorter one can be tried{}",
                         to_text(Time(regular_)), reason(cut_)),
             "look at what the unit received before this instant");
  }
  const std::string who =
      cut_.by == nullptr ? "an event, or the end of the run,"
                         : fmt::format("'{}', which {},", name(*cut_.by),
                                       cut_.is_rejection ? "rejected its step" : "stopped early");
  fail_run({{}, name(lane), {}, interval.from},
           fmt::format("the unit takes steps of one size only, {} s, but {} asks for one of {} s{}",
                       to_text(Time(regular_)), who, to_text(Time(interval.to - interval.from)),
                       reason(cut_)),
           hint);
}

/// In a process of its own it would be asked before what it reaches can be too late.
std::string Stepper::hint_for_final(const Lane& stopped) const {
  const std::string others =
      "use a unit that can save its state in place of one of the two, or a smaller step";
  if (stopped.place->role == StepRole::CanRollBack) return others;
  return fmt::format(
      "let '{0}' have a process of its own, whose snapshots take it back, <stride:Host "
      "components=\"{0}\" process=\"true\"/>, or {1}",
      name(stopped), others);
}

void Stepper::fail_final(const Lane& ahead) const {
  fail_run({{}, name(*cut_.by), {}, cut_.at},
           fmt::format("the unit {}, but '{}' is at {} s already and cannot be rolled back{}",
                       cut_.is_rejection ? "rejected a step from here" : "stopped here",
                       name(ahead), to_text(ahead.result.reached), reason(cut_)),
           hint_for_final(*cut_.by));
}

}  // namespace stride::core
