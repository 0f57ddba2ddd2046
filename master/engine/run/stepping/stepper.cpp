#include "master/engine/run/stepping/stepper.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/engine/model/system/own_step.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"

namespace stride::core {
namespace {

std::string times(std::uint64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

/// Whether the component must not step at the same time as some others.
bool is_main_only(const RunOptions& options, std::size_t component) {
  const auto& components = options.threads.main_only;
  return std::ranges::find(components, component) != components.end();
}

}  // namespace

Stepper::UnitStep::UnitStep(Unit& stepped, CoastingUnit* coasting, const StepOrderEntry& its_entry)
    : unit(&stepped),
      state(coasting),
      component(static_cast<std::uint32_t>(its_entry.component)),
      saves_state(its_entry.saves_state),
      can_vary_step(its_entry.can_vary_step),
      entry(&its_entry),
      concurrent(stepped.capability<ConcurrentSteps>()) {}

Stepper::Stepper(RunContext& context, const std::vector<StepOrderEntry>& order,
                 const std::vector<CoastingUnit*>& coasting, InputExtrapolator* inputs,
                 IdleScheduler* idle, OwnSteps* own_steps)
    : system_(context.system),
      unit_count_(context.units.size()),
      exchange_(context.exchange),
      statistics_(context.statistics.units),
      activities_(context.activities),
      clock_(context.clock),
      step_clock_(context.clock),
      inputs_(inputs),
      idle_(idle),
      own_steps_(own_steps),
      has_grid_(context.options.step.policy->has_grid),
      grid_(context.options.start, has_grid_ ? context.options.step.size : Interval(Duration(1))),
      stop_(context.options.stop),
      minimum_(context.options.step.minimum.rounded()),
      order_(order),
      index_of_(unit_count_),
      times_(unit_count_),
      failures_(unit_count_),
      balancer_(plan(context.options)) {
  for (const StepOrderEntry& entry : order_) {
    index_of_[entry.component] = unit_steps_.size();
    UnitStep& unit_step =
        unit_steps_.emplace_back(*context.units[entry.component], coasting[entry.component], entry);
    unit_step.may_suspend = idle != nullptr && idle->may_suspend(entry.component);
    unit_step.keeps_own_step = entry.keeps_own_step;
    unit_step.is_plain = inputs == nullptr && entry.can_vary_step && !unit_step.may_suspend &&
                         !unit_step.keeps_own_step;
    if (is_main_only(context.options, entry.component)) unit_step.concurrent = nullptr;
    // inputs of a step that are not those of its beginning are no part of the state
    unit_step.can_save_with_step = inputs == nullptr && !unit_step.keeps_own_step;
  }
  form_stages();
  if (context.options.steps_in_rows) form_rows();
}

void Stepper::form_stages() {
  for (std::size_t first = 0, i = 0; i < order_.size(); ++i) {
    if (i + 1 < order_.size() && order_[i + 1].stage == order_[i].stage) continue;
    const auto units = std::span(unit_steps_).subspan(first, i + 1 - first);
    units.back().ends_stage = true;
    stages_.push_back({units, batches(units, first)});
    has_concurrent_ |= !stages_.back().batches.empty();
    first = i + 1;
  }
}

/// `first`: the position of the first one of the units.
std::vector<ThreadShare> Stepper::batches(std::span<const UnitStep> units, std::size_t first) {
  std::vector<ThreadShare> batches;
  if (std::ranges::all_of(units, [](const UnitStep& u) { return u.concurrent == nullptr; })) {
    return batches;
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    batches.resize(units[i].entry->batch + 1);
    batches.back().push_back(first + i);
  }
  return batches;
}

LoadBalancer::Plan Stepper::plan(const RunOptions& options) {
  LoadBalancer::Plan plan;
  plan.threads = options.coupling == Coupling::GaussSeidel ? 1 : options.threads.count;
  plan.always = options.threads.always;
  if (!plan.always) {
    plan.threads = std::min<std::size_t>(plan.threads, std::thread::hardware_concurrency());
  }
  plan.threads = std::clamp<std::size_t>(plan.threads, 1, std::max<std::size_t>(1, unit_count_));
  for (std::size_t i = 0; i < order_.size(); ++i) {
    plan.stages.resize(order_[i].stage + 1);
    plan.stages.back().push_back(i);
    plan.main_only.push_back(is_main_only(options, order_[i].component));
  }
  plan.hand_over = [this] { return pool().measure_hand_over(); };
  return plan;
}

ThreadPool& Stepper::pool() {
  if (!pool_) pool_.emplace(balancer_.threads());
  return *pool_;
}

Time Stepper::advance(Time from, Time target) {
  ++communication_step_;
  early_stop_ = {};
  has_requests_ = false;
  is_short_end_ = target == stop_ && has_grid_ && grid_.is_shorter(target - from);
  step_clock_.measure(clock_.measures() || balancer_.is_measuring());
  if (balancer_.is_deciding()) return make_timed_passes(from, target);
  const Time reached = make_passes(from, target);
  balancer_.end_step();
  return reached;
}

Time Stepper::make_timed_passes(Time from, Time target) {
  const auto began = WallClock::Source::now();
  const Time reached = make_passes(from, target);
  balancer_.end_step(WallClock::Source::now() - began);
  return reached;
}

void Stepper::persist(StateArchive& state) {
  state.mark("steps");
  count_whole_rows();
  state.fixed(unit_steps_, [&](UnitStep& unit_step) { state.value(unit_step.steps); });
}

void Stepper::undo(Time from) {
  for (UnitStep& unit_step : unit_steps_) {
    if (unit_step.keeps_own_step && unit_step.outcome == Outcome::Idle) continue;  // it waits
    report(unit_step, Activity::Kind::Undone, from, unit_step.result.reached);
    restore(unit_step, from);
    ++statistics_[unit_step.component].rollbacks;
  }
}

Time Stepper::make_passes(Time from, Time target) {
  was_parallel_ = balancer_.is_parallel();
  if (from != last_end_) last_end_seconds_ = grid_.seconds(from);
  const StepInterval whole = interval(from, last_end_seconds_, target);
  return make_further_passes(whole, make_pass(whole, true));
}

/// Behind the first one, with which the units have `reached` a time, until all are at the same.
Time Stepper::make_further_passes(const StepInterval& first, Time reached) {
  if (reached != first.to || has_requests_) [[unlikely]]
    note_whole_rows(first.to);
  last_end_ = first.to;
  last_end_seconds_ = first.end_seconds;
  while (reached != last_end_) {
    const StepInterval nearer = interval(first.from, first.begin_seconds, reached);
    last_end_ = nearer.to;
    last_end_seconds_ = nearer.end_seconds;
    reached = make_pass(nearer, false);
  }
  return reached;
}

/// Returns the target if all units have reached it, else the nearer one for the next pass.
inline Time Stepper::make_pass(const StepInterval& interval, bool is_first) {
  if (!balancer_.is_parallel() && !has_concurrent_) [[likely]]
    return step_one_by_one(interval, is_first);
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    const Time reached = step_stage(stages_[i], balancer_.shares(i), interval);
    if (reached != interval.to) return reached;
  }
  return interval.to;
}

/// To the end of the stage in which one of the units stopped. `stepped`: the units up to this one
/// have stepped in rows, and of it there is something to record; or null.
Time Stepper::step_one_by_one(const StepInterval& interval, bool is_first_pass, UnitStep* stepped) {
  const bool may_be_plain =
      is_first_pass && !step_clock_.measures() && interval.from != interval.to;
  const bool may_be_in_row = may_be_plain && exchange_.has_all_to_write();
  Time reached = interval.to;
  UnitStep* const end = unit_steps_.data() + unit_steps_.size();
  UnitStep* unit_step = stepped != nullptr ? stepped : unit_steps_.data();
  for (; unit_step != end; ++unit_step) {
    const bool is_plain = may_be_plain & unit_step->is_plain;
    const bool is_in_row = may_be_in_row & unit_step->begins_row && reached == interval.to;
    const bool is_done =
        unit_step != stepped && (is_in_row ? step_rows({unit_step->row, 1}, unit_step, interval)
                                           : is_plain && step_plainly(*unit_step, interval));
    if (!is_done) [[unlikely]] {
      if (!is_plain) unit_step->outcome = attempt_timed(*unit_step, interval);
      reached = reached_by(*unit_step, interval, reached);
    }
    if (reached != interval.to && unit_step->ends_stage) [[unlikely]]
      break;
  }
  if (reached != interval.to) check_minimum(interval, reached);
  return reached;
}

Time Stepper::step_stage(const Stage& stage, std::span<const ThreadShare> shares,
                         const StepInterval& interval) {
  const bool is_one_by_one = shares.empty() && stage.batches.empty();
  if (!is_one_by_one) step_together(shares, stage.batches, interval);
  Time reached = interval.to;
  for (UnitStep& unit_step : stage.units) {
    if (is_one_by_one) unit_step.outcome = attempt_timed(unit_step, interval);
    reached = reached_by(unit_step, interval, reached);
  }
  if (reached != interval.to) check_minimum(interval, reached);
  return reached;
}

/// The time that all units have reached with this one, whose outcome is recorded.
inline Time Stepper::reached_by(UnitStep& unit_step, const StepInterval& interval, Time reached) {
  const Time allowed = record(unit_step, interval);
  if (allowed >= reached) return reached;
  early_stop_ = {&unit_step, unit_step.result.reached, unit_step.outcome == Outcome::Rejected};
  return allowed;
}

void Stepper::step_together(std::span<const ThreadShare> shares,
                            std::span<const ThreadShare> batches, const StepInterval& interval) {
  if (!shares.empty()) {
    for (const Row& row : rows_) row.units->release();
    pool().run(shares.size(), [&](std::size_t k) noexcept { step_share(shares[k], interval); });
    return;
  }
  for (const ThreadShare& batch : batches) {
    if (!step_share(batch, interval)) return;
  }
}

/// Units that step elsewhere do so while the others step here. Returns whether no unit has failed;
/// what comes behind one that has failed is of no interest. May be called for different units at
/// the same time.
bool Stepper::step_share(const ThreadShare& share, const StepInterval& interval) noexcept {
  for (const std::size_t i : share) {
    UnitStep& unit_step = unit_steps_[i];
    if (unit_step.concurrent == nullptr) continue;
    succeeds(unit_step, [&] { return begin_timed(unit_step, interval); });
  }
  for (const std::size_t i : share) {
    UnitStep& unit_step = unit_steps_[i];
    if (unit_step.concurrent != nullptr) continue;
    if (!succeeds(unit_step, [&] { return attempt_timed(unit_step, interval); })) break;
  }
  for (const std::size_t i : share) {
    UnitStep& unit_step = unit_steps_[i];
    if (unit_step.outcome == Outcome::Failed && !failures_[i].is_consequence) return false;
    if (unit_step.outcome != Outcome::Pending) continue;
    if (!succeeds(unit_step, [&] { return finish(unit_step, interval); })) return false;
  }
  return true;
}

/// Keeps a failure, for rethrow_failure(). Returns whether there is none but a consequence of
/// another one.
template <class Attempt>
bool Stepper::succeeds(UnitStep& unit_step, Attempt&& attempt) noexcept {
  bool is_consequence = false;
  try {
    unit_step.outcome = attempt();
    return true;
  } catch (const ConsequentError&) {
    is_consequence = true;
    failures_[index(unit_step)] = {std::current_exception(), true};
  } catch (...) {
    failures_[index(unit_step)] = {std::current_exception(), false};
  }
  unit_step.outcome = Outcome::Failed;
  return is_consequence;
}

inline StepResult Stepper::save_and_step(UnitStep& unit_step, const StepInterval& interval) {
  return exchange_.with_step_values(
      unit_step.component, *unit_step.unit,
      [&](const StepValues& values) { return unit_step.state->save_and_step(interval, values); });
}

/// The short form of attempt() for most units in most steps. Returns whether there is nothing to
/// record.
inline bool Stepper::step_plainly(UnitStep& unit_step, const StepInterval& interval) {
  unit_step.communication_step = communication_step_;
  unit_step.rejections = 0;
  unit_step.result = unit_step.saves_state
                         ? save_and_step(unit_step, interval)
                         : exchange_.step(unit_step.component, *unit_step.unit, interval);
  ++unit_step.steps;
  if (unit_step.result.reached_without_request(interval.to)) [[likely]]
    return true;
  note_outcome(unit_step, interval);
  return false;
}

/// Of a plain step that did not just reach its end.
void Stepper::note_outcome(UnitStep& unit_step, const StepInterval& interval) {
  unit_step.steps -= unit_step.result.rejected;
  unit_step.rolled_back = false;
  unit_step.outcome = unit_step.result.rejected ? Outcome::Rejected : Outcome::Stepped;
  if (unit_step.result.rejected) {
    unit_step.possible = unit_step.result.reached;
    unit_step.result = {.reached = interval.from};
  }
}

inline Stepper::Outcome Stepper::attempt_timed(UnitStep& unit_step, const StepInterval& interval) {
  return step_clock_.timed(times_[index(unit_step)], [&] { return attempt(unit_step, interval); });
}

inline Stepper::Outcome Stepper::attempt(UnitStep& unit_step, const StepInterval& interval) {
  const Outcome outcome = prepare(unit_step, interval);
  if (outcome != Outcome::Pending) return outcome;
  return conclude(unit_step, make_step(unit_step, interval));
}

inline StepResult Stepper::make_step(UnitStep& unit_step, const StepInterval& interval) {
  if (unit_step.keeps_own_step) return own_steps_->step(unit_step.component, interval.to);
  return unit_step.saves_with_step ? save_and_step(unit_step, interval)
                                   : exchange_.step(unit_step.component, *unit_step.unit, interval);
}

Stepper::Outcome Stepper::begin_timed(UnitStep& unit_step, const StepInterval& interval) {
  return step_clock_.timed(times_[index(unit_step)], [&] { return begin(unit_step, interval); });
}

/// Of a unit that steps elsewhere.
Stepper::Outcome Stepper::begin(UnitStep& unit_step, const StepInterval& interval) {
  const Outcome outcome = prepare(unit_step, interval);
  if (outcome != Outcome::Pending) return outcome;
  const ConcurrentSteps::Extras extras{.saves_state = unit_step.saves_with_step,
                                       .is_timed = step_clock_.measures()};
  if (unit_step.keeps_own_step) {
    own_steps_->begin_step(unit_step.component, interval.to, *unit_step.concurrent, extras);
  } else {
    exchange_.begin_step(unit_step.component, *unit_step.unit, *unit_step.concurrent, interval,
                         extras);
  }
  return outcome;
}

Stepper::Outcome Stepper::finish(UnitStep& unit_step, const StepInterval& interval) {
  StepResult result = unit_step.concurrent->finish_step();
  if (unit_step.keeps_own_step) {
    result = own_steps_->finish_step(unit_step.component, interval.to, result);
  }
  if (step_clock_.measures()) times_[index(unit_step)] += unit_step.concurrent->step_time();
  return conclude(unit_step, result);
}

/// All that comes before a step: Pending if there is to be one.
inline Stepper::Outcome Stepper::prepare(UnitStep& unit_step, const StepInterval& interval) {
  unit_step.rolled_back = unit_step.saves_with_step = false;
  if (unit_step.may_suspend && stays_suspended(unit_step, interval)) return Outcome::Idle;
  if (unit_step.keeps_own_step && waits(unit_step, interval)) return Outcome::Idle;
  if (unit_step.communication_step != communication_step_) [[likely]] {
    unit_step.communication_step = communication_step_;
    unit_step.result = {.reached = interval.from};
    unit_step.rejections = 0;
    if (unit_step.saves_state) save(unit_step, interval);
  } else if (unit_step.result.reached > interval.to) {
    if (!unit_step.saves_state) return Outcome::TooFar;
    roll_back(unit_step, interval);
  }
  if (unit_step.result.reached == interval.to) return Outcome::Idle;
  if (unit_step.keeps_own_step) return Outcome::Pending;
  if (!unit_step.can_vary_step && !grid_.is_regular(interval.to - interval.from))
    fail_size(unit_step, interval);
  if (inputs_ != nullptr) inputs_->before_step(unit_step.component, interval);
  return Outcome::Pending;
}

inline Stepper::Outcome Stepper::conclude(UnitStep& unit_step, const StepResult& result) {
  if (result.rejected) {
    unit_step.possible = result.reached;
    return Outcome::Rejected;
  }
  unit_step.result = result;
  ++unit_step.steps;
  if (inputs_ != nullptr) inputs_->after_step(unit_step.component, result.reached);
  return Outcome::Stepped;
}

/// Whether the unit is suspended and can stay so up to the end of the step. If it cannot, it
/// catches up to the beginning of the step.
bool Stepper::stays_suspended(UnitStep& unit_step, const StepInterval& interval) {
  if (!idle_->is_suspended(unit_step.component)) return false;
  if (!idle_->covers(unit_step.component, interval.to)) {
    idle_->catch_up(unit_step.component, interval.from);
    return false;
  }
  unit_step.communication_step = communication_step_;
  unit_step.result = {.reached = interval.to};
  return true;
}

/// Whether the unit's own step does not end here.
bool Stepper::waits(UnitStep& unit_step, const StepInterval& interval) {
  own_steps_->hold_inputs(unit_step.component, interval.from);
  if (!own_steps_->waits(unit_step.component, interval.to)) return false;
  unit_step.communication_step = communication_step_;
  unit_step.result = {.reached = interval.to};
  return true;
}

/// The inputs are part of the state.
void Stepper::save(UnitStep& unit_step, const StepInterval& interval) {
  unit_step.saves_with_step = unit_step.can_save_with_step && interval.from != interval.to;
  if (unit_step.saves_with_step) return;
  if (!unit_step.keeps_own_step) {
    exchange_.write_routed_inputs(unit_step.component, *unit_step.unit);
  }
  unit_step.state->save_state();
}

void Stepper::roll_back(UnitStep& unit_step, const StepInterval& interval) {
  unit_step.undone = unit_step.result.reached;
  restore(unit_step, interval.from);
  unit_step.rolled_back = true;
  if (interval.from == interval.to) exchange_.read_outputs(unit_step.component, *unit_step.unit);
}

void Stepper::restore(UnitStep& unit_step, Time from) {
  unit_step.state->restore_state();
  unit_step.result = {.reached = from};
  if (unit_step.keeps_own_step) own_steps_->undo(unit_step.component);
  if (inputs_ != nullptr) inputs_->undo_step(unit_step.component);
}

/// Counts the outcome, and returns up to which time the other units may go.
inline Time Stepper::record(UnitStep& unit_step, const StepInterval& interval) {
  if (unit_step.may_suspend) idle_->report_suspension(unit_step.component);
  if (unit_step.rolled_back) {
    ++statistics_[unit_step.component].rollbacks;
    report(unit_step, Activity::Kind::Undone, interval.from, unit_step.undone);
  }
  if (step_clock_.measures()) record_time(unit_step);
  switch (unit_step.outcome) {
    case Outcome::Idle:
      return interval.to;
    case Outcome::Stepped:
      has_requests_ |=
          unit_step.result.event_handling_needed || unit_step.result.terminate_simulation;
      if (unit_step.result.reached != interval.to) {
        ++statistics_[unit_step.component].early_returns;
        report(unit_step, Activity::Kind::EarlyReturn, interval.from, unit_step.result.reached);
      }
      return unit_step.result.reached;
    case Outcome::Rejected:
      ++statistics_[unit_step.component].rejections;
      ++unit_step.rejections;
      report(unit_step, Activity::Kind::Rejection, interval.from, interval.to);
      return retry_target(unit_step, interval);
    case Outcome::TooFar:
      fail_final(unit_step);
    case Outcome::Pending:  // behind a unit that has failed
    case Outcome::Failed:
      break;
  }
  rethrow_failure(unit_step);
}

/// The next target after a rejected step.
Time Stepper::retry_target(const UnitStep& unit_step, const StepInterval& interval) {
  const bool is_said = interval.from < unit_step.possible && unit_step.possible < interval.to;
  return is_said ? unit_step.possible : interval.from + (interval.to - interval.from) / 2;
}

void Stepper::record_time(const UnitStep& unit_step) {
  const std::chrono::nanoseconds time = std::exchange(times_[index(unit_step)], {});
  if (clock_.measures()) statistics_[unit_step.component].step_time += time;
  if (balancer_.is_measuring()) balancer_.record_cost(index(unit_step), time);
}

/// The first failure in the step order that is not a consequence of another one.
void Stepper::rethrow_failure(const UnitStep& first) const {
  for (const UnitStep& unit_step : stages_[first.entry->stage].units) {
    const Failure& failure = failures_[index(unit_step)];
    if (unit_step.outcome == Outcome::Failed && !failure.is_consequence) {
      std::rethrow_exception(failure.cause);
    }
  }
  std::rethrow_exception(failures_[index(first)].cause);
}

const std::string& Stepper::name(const UnitStep& unit_step) const {
  return system_.components()[unit_step.component].name;
}

void Stepper::check_minimum(const StepInterval& interval, Time reached) const {
  const bool is_large_enough = reached - interval.from >= minimum_ && reached > interval.from;
  if (is_large_enough || !early_stop_.is_rejection) return;
  fail_run({{}, name(*early_stop_.by), {}, interval.from},
           fmt::format("the unit rejected the step to {} s, {} in all, and the next one to try, to "
                       "{} s, would be shorter than the minimum of {} s{}",
                       to_text(interval.to), times(early_stop_.by->rejections), to_text(reached),
                       to_text(minimum_), reason(early_stop_)),
           is_short_end_
               ? fmt::format("the last step is shorter than the others, {} s, since the "
                             "run ends at {} s: if the unit makes whole steps only, stop "
                             "at a multiple of its step (--stop {})",
                             to_text(grid_.step()), to_text(stop_), to_text(interval.from))
               : "look at what the unit received before this instant");
}

/// The unit's reason for the rejection.
std::string Stepper::reason(const EarlyStop& stop) const {
  auto* const unit = stop.is_rejection ? stop.by->unit->capability<UnitDiagnostics>() : nullptr;
  const std::string text = unit != nullptr ? unit->rejection_reason() : "";
  return text.empty() ? "" : "; message of the unit: " + text;
}

void Stepper::fail_size(const UnitStep& unit_step, const StepInterval& interval) const {
  const bool is_early_return = early_stop_.by != nullptr && !early_stop_.is_rejection;
  const std::string hint = fmt::format(
      "{}use a unit with canHandleVariableCommunicationStepSize, or none that has events or stops "
      "early",
      is_early_return ? fmt::format("let '{0}' make whole steps, <stride:EarlyReturn components="
                                    "\"{0}\" allowed=\"false\"/>, or ",
                                    name(*early_stop_.by))
                      : "");
  if (early_stop_.by == &unit_step) {
    const std::string other_step = own_step_hint(
        name(unit_step), *system_.components()[unit_step.component].description, grid_.step());
    fail_run(
        {{}, name(unit_step), {}, interval.from},
        fmt::format("the unit rejected its step, and takes steps of one size only, {} s, so "
                    "no shorter one can be tried{}",
                    to_text(grid_.step()), reason(early_stop_)),
        other_step.empty() ? "look at what the unit received before this instant" : other_step);
  }
  const std::string cause =
      early_stop_.by == nullptr
          ? "an event, or the end of the run,"
          : fmt::format("'{}', which {},", name(*early_stop_.by),
                        early_stop_.is_rejection ? "rejected its step" : "stopped early");
  fail_run({{}, name(unit_step), {}, interval.from},
           fmt::format("the unit takes steps of one size only, {} s, but {} requires one of {} s{}",
                       to_text(grid_.step()), cause, to_text(interval.to - interval.from),
                       reason(early_stop_)),
           hint);
}

/// A unit with snapshots can be rolled back, so it steps before the others are too far.
std::string Stepper::hint_for_final(const UnitStep& stopped) const {
  const std::string others =
      "use a unit that can save its state in place of one of the two, or a smaller step";
  if (stopped.entry->role == StepRole::CanRollBack) return others;
  return fmt::format(
      "run '{0}' in a process of its own, whose snapshots roll it back, <stride:Host "
      "components=\"{0}\" snapshots=\"true\"/>, or {1}",
      name(stopped), others);
}

void Stepper::fail_final(const UnitStep& ahead) const {
  fail_run({{}, name(*early_stop_.by), {}, early_stop_.at},
           fmt::format("the unit {}, but '{}' is at {} s already and cannot be rolled back{}",
                       early_stop_.is_rejection ? "rejected a step from here" : "stopped here",
                       name(ahead), to_text(ahead.result.reached), reason(early_stop_)),
           hint_for_final(*early_stop_.by));
}

}  // namespace stride::core
