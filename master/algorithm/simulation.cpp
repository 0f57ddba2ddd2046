#include "master/algorithm/simulation.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/algorithm/capabilities/configuration_mode.h"
#include "master/algorithm/capabilities/host_diagnostics.h"
#include "master/algorithm/capabilities/inputs_within_step.h"
#include "master/algorithm/capabilities/unit_diagnostics.h"
#include "master/algorithm/events/event_handler.h"
#include "master/algorithm/events/interventions.h"
#include "master/algorithm/idle/idle_scheduler.h"
#include "master/algorithm/loops/ordered_evaluation.h"
#include "master/algorithm/run_context.h"
#include "master/algorithm/step_policies/step_policy.h"
#include "master/algorithm/stepping/coasting_unit.h"
#include "master/algorithm/stepping/input_extrapolator.h"
#include "master/algorithm/stepping/step_order.h"
#include "master/algorithm/stepping/stepper.h"
#include "master/algorithm/time_sampling.h"

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
        idle_(make_idle_scheduler()),
        event_handler_(context_, idle_.get()),
        interventions_(context_, event_handler_, idle_.get()),
        stepper_(context_, order_, coasting_, sets_inputs_in_steps() ? inputs_.get() : nullptr,
                 idle_.get()) {
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
  std::span<const Verdict> verdicts() const { return verdicts_; }

  void run() {
    if (std::exchange(has_run_, true)) throw std::logic_error("a simulation runs once");
    began_ = WallClock::Source::now();
    std::exception_ptr failure;
    try {
      clock_.timed(statistics_.phases.initialization, [&] { initialize(); });
      is_initialized_ = true;
      sampling_.begin();
      while (should_continue()) {
        sampling_.begin_step();
        communication_step();
        sampling_.end_step();
      }
      if (idle_) idle_->catch_up_all(time_);
      if (statistics_.end != RunEnd::Interrupted) verdicts_ = read_verdicts(system_, units_);
    } catch (...) {
      failure = std::current_exception();
    }
    terminate_units(failure);
    statistics_.wall_time = WallClock::Source::now() - began_;
    sampling_.end();
    collect_unit_statistics();
    free_units(failure);
    finish_suspensions(failure);
    finish_observers(failure);
    if (!failure) return;
    verdicts_.clear();
    std::rethrow_exception(failure);
  }

  void abandon() noexcept {
    statistics_.wall_time = WallClock::Source::now() - began_;
    sampling_.end();
    std::exception_ptr ignored;
    finish_observers(ignored);
  }

 private:
  std::size_t count() const { return units_.size(); }
  bool sets_inputs_in_steps() const { return options_.sets_inputs_in_steps(); }

  /// Those whose states are saved need not be saved before each step.
  std::vector<std::unique_ptr<Unit>> coasting(const System& system,
                                              std::vector<std::unique_ptr<Unit>> units,
                                              const RunOptions& options) {
    const auto& [each_step, most_steps, always] = options.checkpoints;
    coasting_.resize(units.size());
    const auto saved =
        static_cast<std::size_t>(std::ranges::count_if(order_, &StepOrderEntry::saves_state));
    for (const StepOrderEntry& entry : order_) {
      if (!entry.saves_state) continue;
      const std::size_t i = entry.component;
      const std::size_t most = std::ranges::count(each_step, i) > 0 ? 1 : most_steps;
      auto unit =
          std::make_unique<CoastingUnit>(std::move(units[i]), *system.components()[i].description,
                                         CheckpointInterval(most, !always), kNoteCache / saved);
      coasting_[i] = unit.get();
      units[i] = std::move(unit);
    }
    return units;
  }

  void collect_unit_statistics() {
    for (std::size_t i = 0; i < count(); ++i) {
      auto* const diagnostics = units_[i]->capability<UnitDiagnostics>();
      auto* const process = units_[i]->capability<HostDiagnostics>();
      if (diagnostics != nullptr) statistics_.units[i].calls = diagnostics->calls();
      if (process != nullptr) statistics_.units[i].host = process->host_statistics();
      statistics_.units[i].steps = stepper_.steps(i) + statistics_.units[i].suspensions;
    }
    for (std::size_t i = 0; i < count(); ++i) {
      if (coasting_[i] == nullptr) continue;
      const CoastingUnit::Counts& counts = coasting_[i]->counts();
      statistics_.units[i].saves = counts.saves;
      statistics_.units[i].repeated_steps = counts.repeated_steps;
      statistics_.units[i].inexact_repetition = counts.inexact_repetition;
    }
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
    if (!idle_ || !failure) return;
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
    configure();
    for (const StartValue& start : system_.start_values()) set(start);
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
    handle_events();
    notify_observers();
  }

  void notify_observers() {
    context_.outputs.update();
    for (Observer* observer : context_.observers) observer->on_communication_point(time_);
  }

  /// Structural parameters give arrays their sizes, so they are set first.
  void configure() {
    const std::span<const StartValue> all = system_.structural_values();
    for (auto first = all.begin(); first != all.end();) {
      auto& configuration = units_[first->id.component]->require_capability<ConfigurationMode>();
      const auto last = std::find_if(first, all.end(), [&](const StartValue& value) {
        return value.id.component != first->id.component;
      });
      configuration.enter_configuration_mode();
      std::for_each(first, last, [&](const StartValue& value) { set(value); });
      configuration.exit_configuration_mode();
      first = last;
    }
  }

  /// FMI sets an array as a whole. Before the initialisation, the unit has its own start values.
  void set(const StartValue& start) {
    Unit& unit = *units_[start.id.component];
    const Variable& variable = system_.variable(start.id);
    if (start.kept.empty()) return unit.set({&variable.reference, 1}, start.value);
    ValueBlock own(variable.type, variable.size);
    unit.get({&variable.reference, 1}, own);
    unit.set({&variable.reference, 1}, start.over(own));
  }

  void start_observers() {
    for (std::size_t i = 0; i < context_.observers.size(); ++i) {
      std::vector<Signal> signals;
      for (const VariableId id : wanted_[i])
        signals.push_back(context_.outputs.signal(id, exchange_));
      context_.observers[i]->on_start(signals);
    }
  }

  /// Nothing where inputs are held and their error is not controlled.
  std::unique_ptr<InputExtrapolator> make_input_extrapolator() {
    if (!sets_inputs_in_steps() && !options_.step.policy->controls_error) return nullptr;
    return std::make_unique<InputExtrapolator>(context_);
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

  bool should_continue() {
    if (time_ >= options_.stop || statistics_.end == RunEnd::EndedByUnit) return false;
    if (options_.interrupted == nullptr || *options_.interrupted == 0) [[likely]]
      return true;
    statistics_.end = RunEnd::Interrupted;
    return false;
  }

  void communication_step() {
    const Time reached = clock_.timed(statistics_.phases.steps, [&] { return advance(); });
    if (stepper_.has_requests()) note_requested_end();
    if (reached == time_) {
      if (statistics_.end == RunEnd::EndedByUnit) return;  // this point has been observed
      check_stall();
    } else {
      stalled_steps_ = 0;
    }
    time_ = reached;
    if (stepper_.has_requests()) handle_requests();
    clock_.timed(statistics_.phases.instants, [&] { handle_events(); });
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
    if (idle_) {
      const auto quiet_until = idle_->all_suspended_until(time_);
      if (quiet_until) target = step_policy_->next_while_idle(time_, *quiet_until);
    }
    if (target == time_) target = step_policy_->next(time_);
    return interventions_.next(event_handler_.next_event(target));
  }

  void handle_events() {
    event_handler_.begin_instant(time_);
    interventions_.make(time_);
    event_handler_.handle_events();
    if (inputs_) inputs_->accept(time_, event_handler_.had_event());
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
  std::unique_ptr<IdleScheduler> idle_;        ///< nothing where no unit may be suspended
  EventHandler event_handler_;
  Interventions interventions_;
  Stepper stepper_;

  std::vector<std::vector<VariableId>> wanted_;  ///< the signals of each observer
  std::vector<Verdict> verdicts_;

  bool has_run_ = false;
  bool is_initialized_ = false;
  WallClock::Source::time_point began_{};
  Time time_{};
  std::uint32_t stalled_steps_ = 0;
};

Simulation::Simulation(const System& system, std::vector<std::unique_ptr<Unit>> units,
                       RunOptions options)
    : run_(std::make_unique<Run>(system, std::move(units), std::move(options))) {}

Simulation::~Simulation() = default;

void Simulation::add_observer(Observer& observer) { run_->add_observer(observer); }

void Simulation::add_observer(Observer& observer, std::vector<VariableId> signals) {
  run_->add_observer(observer, std::move(signals));
}

void Simulation::run() { run_->run(); }

void Simulation::abandon() noexcept { run_->abandon(); }

Duration Simulation::suspended_time() const { return run_->suspended_time(); }

const RunStatistics& Simulation::statistics() const { return run_->statistics(); }

std::span<const Verdict> Simulation::verdicts() const { return run_->verdicts(); }

}  // namespace stride::core
