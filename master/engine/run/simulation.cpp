#include "master/engine/run/simulation.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/events/event_handler.h"
#include "master/engine/run/events/interventions.h"
#include "master/engine/run/idle/idle_scheduler.h"
#include "master/engine/run/loops/ordered_evaluation.h"
#include "master/engine/run/pauses.h"
#include "master/engine/run/start_values.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/engine/run/stepping/coasting_unit.h"
#include "master/engine/run/stepping/input_extrapolator.h"
#include "master/engine/run/stepping/own_steps.h"
#include "master/engine/run/stepping/step_order.h"
#include "master/engine/run/stepping/stepper.h"
#include "master/engine/run/stretch.h"
#include "master/engine/run/time_sampling.h"
#include "master/engine/run/unit_counters.h"

namespace stride::core {
namespace {

/// For what is noted of units whose states are not saved before each step [byte].
constexpr std::size_t kNoteCache = std::size_t{512} << 10;

/// Successive steps that end where they began, after which the run fails.
constexpr std::uint32_t kStallLimit = 1000;

}  // namespace

class Simulation::Run {
 public:
  Run(const System& system, std::vector<std::unique_ptr<Unit>> units, RunOptions options)
      : order_(step_order(system, *options.step.policy, options.coupling)),
        context_{system, coasting(system, std::move(units), options),
                 std::move(options)},  // in this order, hence the braces
        step_policy_(make_step_policy(system_, options_)),
        inputs_(make_input_extrapolator()),
        own_steps_(make_own_steps()),
        idle_(make_idle_scheduler()),
        event_handler_(context_, idle_.get(), own_steps_.get()),
        interventions_(context_, event_handler_),
        stepper_(context_, order_, coasting_, inputs_in_steps(), idle_.get(), own_steps_.get()),
        counters_(context_, coasting_, stepper_) {
    if (sets_inputs_in_steps()) connect_input_updates();
  }

  void add_observer(Observer& observer) { add_observer(observer, options_.recorded); }
  void add_observer(Observer& observer, std::vector<VariableId> signals) {
    const auto is_read = [&](VariableId id) {
      return std::ranges::binary_search(context_.observed, id);
    };
    if (!std::ranges::all_of(signals, is_read)) {
      throw std::logic_error("an observer requested a signal that is not read");
    }
    context_.observers.push_back(&observer);
    wanted_.push_back(std::move(signals));
    context_.activities.add(observer);
  }
  const RunStatistics& statistics() const { return statistics_; }
  Duration suspended_time() const { return idle_ ? idle_->suspended_time(time_) : Duration{}; }
  bool was_suspended(std::size_t component) const {
    return idle_ && idle_->was_suspended(component, time_);
  }
  std::span<const Verdict> verdicts() const { return verdicts_; }

  void set_control(RunControl& control) { pauses_.set_control(control); }

  void run() {
    begin();
    advance(options_.stop);
    end();
  }

  void resume(StateArchive& state, const std::function<void()>& started) {
    begin(state, started);
    advance(options_.stop);
    end();
  }

  void begin() {
    start([&] { initialize(); });
  }

  void begin(StateArchive& state, const std::function<void()>& started) {
    start([&] {
      is_initialized_ = true;
      restore(state);
      start_observers();
      started();
    });
  }

  void advance(Time until) {
    make_part([&] {
      context_.until = std::min(until, options_.stop);
      go_on();
    });
  }

  void make_event(ChangesAtInstant changes) {
    make_part([&] {
      if (!changes.interventions.empty()) {
        interventions_.add(std::move(changes.interventions), time_);
      }
      for (const SentMessage& message : changes.messages) event_handler_.send(message);
      handle_events(changes.sets);
      notify_observers();
    });
  }

  ValueBlock value(VariableId id) {
    std::optional<ValueBlock> value;
    make_part([&] { value = read_value(id); });
    return *std::move(value);
  }

  void end() {
    check_between_parts();
    began_ = WallClock::Source::now();
    if (time_ < options_.stop && statistics_.end == RunEnd::Completed) {
      statistics_.end = RunEnd::EndedEarly;
    }
    end_behind([] {});
  }

  void persist(StateArchive& state) {
    if (!is_between_parts_) pauses_.check_paused();
    if (state.is_reading()) throw std::logic_error("a state is read by resume() only");
    persist_all(state);
  }

  void add_interventions(std::vector<Intervention> interventions) {
    pauses_.check_paused();
    interventions_.add(std::move(interventions), time_ + Duration(1));
  }

  void run_rest() {
    pauses_.check_paused();
    end_behind([&] {
      pauses_.begin(time_);
      go_on();
    });
  }

  void abandon() noexcept {
    if (!is_between_parts_) add_wall_time(statistics_);
    sampling_.end();
    std::exception_ptr ignored;
    finish_observers(ignored);
  }

 private:
  std::size_t count() const { return units_.size(); }
  bool sets_inputs_in_steps() const { return options_.sets_inputs_in_steps(); }
  InputExtrapolator* inputs_in_steps() const {
    return sets_inputs_in_steps() ? inputs_.get() : nullptr;
  }

  /// The part before the first step. `begin` leaves the units in Step Mode.
  template <class Begin>
  void start(Begin&& begin) {
    if (std::exchange(has_run_, true)) throw std::logic_error("a simulation runs once");
    is_between_parts_ = true;
    make_part([&] {
      clock_.timed(statistics_.phases.initialization, begin);
      is_initialized_ = true;
      sampling_.begin();
      pauses_.begin(time_);
    });
  }

  /// If it fails, the run has ended.
  template <class Part>
  void make_part(Part&& part) {
    check_between_parts();
    is_between_parts_ = false;
    began_ = WallClock::Source::now();
    try {
      part();
    } catch (...) {
      conclude(std::current_exception());
    }
    add_wall_time(statistics_);
    is_between_parts_ = true;
  }

  void check_between_parts() const {
    if (!is_between_parts_) throw std::logic_error("the run has not begun, is under way or over");
  }

  /// The last part of the run, and what follows it.
  template <class Steps>
  void end_behind(Steps&& steps) {
    std::exception_ptr failure;
    try {
      steps();
      if (idle_) idle_->catch_up_all(time_);
      if (own_steps_) own_steps_->catch_up_all(time_);
      if (statistics_.end != RunEnd::Interrupted) verdicts_ = read_verdicts(system_, units_);
    } catch (...) {
      failure = std::current_exception();
    }
    conclude(failure);
  }

  /// What follows the last step, whether the steps have succeeded or not.
  void conclude(std::exception_ptr failure) {
    is_between_parts_ = false;
    terminate_units(failure);
    add_wall_time(statistics_);
    sampling_.end();
    counters_.add_to(statistics_);
    free_units(failure);
    finish_suspensions(failure);
    finish_observers(failure);
    if (!failure) return;
    verdicts_ = undecided_verdicts(system_);
    std::rethrow_exception(failure);
  }

  void add_wall_time(RunStatistics& statistics) const {
    statistics.wall_time += WallClock::Source::now() - began_;
  }

  /// Those whose states are saved need not be saved before each step.
  std::vector<std::unique_ptr<Unit>> coasting(const System& system,
                                              std::vector<std::unique_ptr<Unit>> units,
                                              const RunOptions& options) {
    const auto& [each_step, most_steps, always] = options.state_saving;
    coasting_.resize(units.size());
    const auto saved =
        static_cast<std::size_t>(std::ranges::count_if(order_, &StepOrderEntry::saves_state));
    for (const StepOrderEntry& entry : order_) {
      if (!entry.saves_state) continue;
      const std::size_t i = entry.component;
      const std::size_t most = std::ranges::count(each_step, i) > 0 ? 1 : most_steps;
      auto unit =
          std::make_unique<CoastingUnit>(std::move(units[i]), *system.components()[i].description,
                                         SaveInterval(most, !always), kNoteCache / saved);
      coasting_[i] = unit.get();
      units[i] = std::move(unit);
    }
    return units;
  }

  /// Those that have failed do nothing, and before the end of the initialisation no unit may be
  /// terminated. The first failure is kept.
  void terminate_units(std::exception_ptr& failure) {
    if (!is_initialized_) return;
    for (auto& unit : units_) {
      try {
        unit->terminate();
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    }
  }

  /// After a failure the destructors do so, since a second failure is of no interest.
  void free_units(std::exception_ptr& failure) {
    if (failure) return;
    try {
      for (auto& unit : units_) unit->free();
    } catch (...) {
      failure = std::current_exception();
    }
  }

  void finish_suspensions(std::exception_ptr& failure) {
    if (!idle_ || !failure || !has_started_observers_) return;
    try {
      idle_->report_unfinished(time_);
    } catch (...) {  // the first failure is kept
    }
  }

  /// Calls all observers, even if one of them fails, and keeps the first failure.
  void finish_observers(std::exception_ptr& failure) {
    for (Observer* observer : context_.observers) {
      try {
        observer->on_finish();
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    }
  }

  void initialize() {
    time_ = options_.start;
    configure(context_);
    set_start_values(context_);
    if (idle_) idle_->enable();
    for (std::size_t i = 0; i < count(); ++i) {
      clock_.timed(statistics_.units[i].initialization_time,
                   [&] { units_[i]->enter_initialization(options_.start, options_.stop); });
    }
    set_initial_values(context_, time_);
    for (std::size_t i = 0; i < count(); ++i) exchange_.begin_samples(i, *units_[i]);
    event_handler_.begin_clocks(time_);
    for (std::size_t i = 0; i < count(); ++i) {
      clock_.timed(statistics_.units[i].initialization_time,
                   [&] { units_[i]->exit_initialization(); });
    }
    start_observers();
    event_handler_.begin();
    handle_events({});
    notify_observers();
  }

  void notify_observers() {
    context_.outputs.update(time_);
    for (Observer* observer : context_.observers) observer->on_communication_point(time_);
  }

  void start_observers() {
    for (std::size_t i = 0; i < context_.observers.size(); ++i) {
      std::vector<Signal> signals;
      for (const VariableId id : wanted_[i])
        signals.push_back(context_.outputs.signal(id, exchange_));
      context_.observers[i]->on_start(signals);
    }
    has_started_observers_ = true;
  }

  /// Nothing where inputs are held and their error is not controlled.
  std::unique_ptr<InputExtrapolator> make_input_extrapolator() {
    if (!sets_inputs_in_steps() && !options_.step.policy->controls_error) return nullptr;
    return std::make_unique<InputExtrapolator>(context_);
  }

  std::unique_ptr<OwnSteps> make_own_steps() {
    auto own_steps = std::make_unique<OwnSteps>(context_, inputs_in_steps());
    if (own_steps->is_trivial()) return nullptr;
    if (inputs_) inputs_->set_own_steps(*own_steps);
    return own_steps;
  }

  std::unique_ptr<IdleScheduler> make_idle_scheduler() {
    if (!options_.may_skip_idle_time()) return nullptr;
    auto idle = std::make_unique<IdleScheduler>(context_);
    return idle->is_trivial() ? nullptr : std::move(idle);
  }

  void connect_input_updates() {
    for (std::size_t i = 0; i < count(); ++i) {
      Unit& unit = *units_[i];
      auto* const inputs = unit.capability<InputsWithinStep>();
      if (inputs == nullptr) continue;
      inputs->set_input_update(
          [this, i, &unit](double seconds) { inputs_->within_step(i, unit, seconds); });
    }
  }

  /// Up to the end of this part.
  void go_on() {
    while (true) {
      if (pauses_.may_be_due(time_)) [[unlikely]]
        make_pauses();
      if (!should_continue()) break;
      if (const std::uint64_t steps = stretch_.steps_from(time_); steps != 0) {
        make_stretch(steps);
        continue;
      }
      sampling_.begin_step();
      communication_step();
      sampling_.end_step();
    }
    if (statistics_.end == RunEnd::Interrupted) pauses_.interrupt(time_);
  }

  void make_pauses() {
    if (statistics_.end == RunEnd::EndedByUnit) return;
    pauses_.make(time_, [&] { return time_ < options_.stop ? next_target() : Time::min(); });
  }

  void restore(StateArchive& state) {
    persist_all(state);
    for (std::size_t i = 0; i < count(); ++i) exchange_.read_new_outputs(i, *units_[i]);
    if (idle_) idle_->take_new_tangents(time_);
    interventions_.go_on(time_);
    counters_.resume();
    context_.outputs.update(time_);
  }

  void persist_all(StateArchive& state) {
    state.mark("run");
    state.value(time_);
    if (time_ < options_.start || time_ > options_.stop) state.fail("its time is not in the run");
    state.value(stalled_steps_);
    if (stalled_steps_ >= kStallLimit) state.fail("too many steps ended where they began");
    persist_statistics(state);
    exchange_.persist(state);
    event_handler_.persist(state, options_.start, time_);
    if (idle_) idle_->persist(state, options_.start, time_);
    if (own_steps_) own_steps_->persist(state, options_.start, time_);
    if (inputs_) inputs_->persist(state, options_.start, time_);
    step_policy_->persist(state);
    stepper_.persist(state);
    for (CoastingUnit* unit : coasting_) {
      if (unit != nullptr) unit->persist(state);
    }
  }

  /// Those up to here, as they would be if the run had ended.
  void persist_statistics(StateArchive& state) {
    if (state.is_reading()) {
      core::persist(state, statistics_);
      statistics_.reached = time_;
      return;
    }
    RunStatistics present = statistics_;
    if (!is_between_parts_) add_wall_time(present);
    sampling_.scale(present);
    counters_.add_to(present);
    core::persist(state, present);
  }

  bool should_continue() {
    if (time_ >= context_.until || statistics_.end == RunEnd::EndedByUnit) return false;
    if (options_.interrupted == nullptr || *options_.interrupted == 0) [[likely]]
      return true;
    statistics_.end = RunEnd::Interrupted;
    return false;
  }

  void make_stretch(std::uint64_t steps) {
    const Time began = time_;
    const std::optional<Time> reached = stretch_.make(time_, steps);
    if (time_ != began) stalled_steps_ = 0;
    if (reached) conclude_step(*reached);
  }

  void communication_step() {
    conclude_step(clock_.timed(statistics_.phases.steps, [&] { return advance(); }));
  }

  /// When all units have reached this time.
  void conclude_step(Time reached) {
    if (stepper_.has_requests()) note_requested_end();
    if (reached == time_) {
      if (statistics_.end == RunEnd::EndedByUnit) return;  // this point has been observed
      check_stall();
    } else {
      stalled_steps_ = 0;
    }
    time_ = reached;
    if (stepper_.has_requests()) handle_requests();
    clock_.timed(statistics_.phases.instants, [&] { handle_events({}); });
    ++statistics_.communication_steps;
    statistics_.parallel_steps += stepper_.was_parallel();
    statistics_.reached = time_;
    clock_.timed(statistics_.phases.observers, [&] { notify_observers(); });
  }

  void handle_requests() {
    for (std::size_t i = 0; i < count(); ++i) {
      const StepResult& result = stepper_.result(i);
      if (!result.event_handling_needed) continue;
      if (!result.early_return && !event_handler_.has_announced(i, time_)) {
        ++statistics_.units[i].unannounced_events;
      }
      event_handler_.request_event(i);
    }
  }

  void note_requested_end() {
    for (std::size_t i = 0; i < count(); ++i) {
      if (stepper_.result(i).terminate_simulation) statistics_.end = RunEnd::EndedByUnit;
    }
  }

  bool are_steps_on_grid() const {
    return own_steps_ == nullptr || own_steps_->are_multiples_of(options_.step.size);
  }

  /// Steps all units to the next communication point; repeated while the policy does not accept the
  /// error.
  Time advance() {
    while (true) {
      const Time reached = stepper_.advance(time_, next_target());
      if (!options_.step.policy->controls_error) return reached;
      const ExtrapolationError error = inputs_->extrapolation_error(
          reached, options_.step.absolute_tolerance, options_.step.relative_tolerance);
      if (step_policy_->accept(time_, reached, error)) return reached;
      stepper_.undo(time_);
      ++statistics_.undone_steps;
    }
  }

  /// The point that the step policy chooses, or the next event if that is earlier.
  Time next_target() {
    Time target = time_;
    const Time own_end = own_steps_ ? own_steps_->next(time_) : Time::max();
    if (idle_) {
      const auto quiet_until = idle_->all_suspended_until(time_);
      if (quiet_until) {
        target = step_policy_->next_while_idle(time_, std::min(*quiet_until, own_end));
      }
    }
    if (target == time_) target = step_policy_->next(time_);
    target = std::min(target, own_end);
    return std::min(interventions_.next(event_handler_.next_event(target)), context_.until);
  }

  void handle_events(std::span<const Intervention> sets) {
    event_handler_.begin_instant(time_);
    interventions_.make(time_);
    interventions_.make_sets(sets, time_);
    event_handler_.handle_events();
    if (inputs_) inputs_->accept(time_, event_handler_.had_event());
  }

  ValueBlock read_value(VariableId id) {
    if (system_.is_output(id)) return read_output(system_.outputs()[id.variable]);
    if (exchange_.has(id)) return exchange_.value(id);
    if (idle_ && idle_->is_suspended(id.component)) {
      idle_->catch_up_and_report(id.component, time_);
    }
    const Variable& variable = system_.variable(id);
    ValueBlock value(variable.type, variable.size);
    units_[id.component]->get({&variable.reference, 1}, value);
    return value;
  }

  ValueBlock read_output(const SystemOutput& output) {
    if (output.constant) return *output.constant;
    ValueBlock value(output.variable.type, output.variable.size);
    copy_elements(value, 0, read_value(output.from), output.from_first, value.size(),
                  output.conversion);
    return value;
  }

  void check_stall() {
    if (++stalled_steps_ < kStallLimit) return;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count(); ++i) {
      if (stepper_.result(i).early_return) names.push_back(system_.components()[i].name);
    }
    fail_run(
        {{}, {}, {}, time_},
        fmt::format("{} steps in a row ended where they began, because these units stopped: {}",
                    kStallLimit, quoted(names)));
  }

  const std::vector<StepOrderEntry> order_;
  std::vector<CoastingUnit*> coasting_;  ///< by component; null where no state is saved
  RunContext context_;
  const System& system_ = context_.system;
  std::span<const std::unique_ptr<Unit>> units_ = context_.units;
  const RunOptions& options_ = context_.options;
  Exchange& exchange_ = context_.exchange;
  RunStatistics& statistics_ = context_.statistics;
  const WallClock& clock_ = context_.clock;
  TimeSampling sampling_{context_.clock, context_.statistics};

  std::unique_ptr<StepPolicy> step_policy_;
  std::unique_ptr<InputExtrapolator> inputs_;  ///< nothing where inputs are held
  std::unique_ptr<OwnSteps> own_steps_;        ///< nothing where no component has its own step
  std::unique_ptr<IdleScheduler> idle_;        ///< nothing where no unit may be suspended
  EventHandler event_handler_;
  Interventions interventions_;
  Stepper stepper_;
  UnitCounters counters_;

  std::vector<std::vector<VariableId>> wanted_;  ///< the signals of each observer
  std::vector<Verdict> verdicts_ = undecided_verdicts(system_);

  bool has_run_ = false;
  bool is_between_parts_ = false;
  bool is_initialized_ = false;
  bool has_started_observers_ = false;
  WallClock::Source::time_point began_{};
  Time time_{};
  std::uint32_t stalled_steps_ = 0;
  Pauses pauses_;
  Stretch stretch_{context_,
                   {*step_policy_, event_handler_, interventions_, pauses_, stepper_, sampling_},
                   inputs_ == nullptr&& idle_ == nullptr&& are_steps_on_grid()};
};

Simulation::Simulation(const System& system, std::vector<std::unique_ptr<Unit>> units,
                       RunOptions options)
    : run_(std::make_unique<Run>(system, std::move(units), std::move(options))) {}

Simulation::~Simulation() = default;

void Simulation::add_observer(Observer& observer) { run_->add_observer(observer); }

void Simulation::add_observer(Observer& observer, std::vector<VariableId> signals) {
  run_->add_observer(observer, std::move(signals));
}

void Simulation::set_control(RunControl& control) { run_->set_control(control); }

void Simulation::run() { run_->run(); }

void Simulation::resume(StateArchive& state, const std::function<void()>& started) {
  run_->resume(state, started);
}

void Simulation::persist(StateArchive& state) { run_->persist(state); }

void Simulation::add_interventions(std::vector<Intervention> interventions) {
  run_->add_interventions(std::move(interventions));
}

void Simulation::run_rest() { run_->run_rest(); }

void Simulation::begin() { run_->begin(); }

void Simulation::begin(StateArchive& state, const std::function<void()>& started) {
  run_->begin(state, started);
}

void Simulation::advance(Time until) { run_->advance(until); }

void Simulation::make_event(ChangesAtInstant changes) { run_->make_event(std::move(changes)); }

ValueBlock Simulation::value(VariableId id) { return run_->value(id); }

void Simulation::end() { run_->end(); }

void Simulation::abandon() noexcept { run_->abandon(); }

Duration Simulation::suspended_time() const { return run_->suspended_time(); }

bool Simulation::was_suspended(std::size_t component) const {
  return run_->was_suspended(component);
}

const RunStatistics& Simulation::statistics() const { return run_->statistics(); }

std::span<const Verdict> Simulation::verdicts() const { return run_->verdicts(); }

}  // namespace stride::core
