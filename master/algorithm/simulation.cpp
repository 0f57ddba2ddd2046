#include "master/algorithm/simulation.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/algorithm/activities.h"
#include "master/algorithm/capabilities/configuration_mode.h"
#include "master/algorithm/capabilities/inputs_within_step.h"
#include "master/algorithm/capabilities/own_process.h"
#include "master/algorithm/capabilities/unit_diagnostics.h"
#include "master/algorithm/events/instant.h"
#include "master/algorithm/exchange/exchange.h"
#include "master/algorithm/exchange/system_outputs.h"
#include "master/algorithm/idle/idle_ledger.h"
#include "master/algorithm/loops/initial_values.h"
#include "master/algorithm/stepping/step_inputs.h"
#include "master/algorithm/stepping/step_size.h"
#include "master/algorithm/stepping/stepper.h"

namespace stride::core {
namespace {

/// Steps in a row that end where they began, after which a unit is taken to be stuck.
constexpr std::uint32_t kStallLimit = 1000;

/// All that observers may see, each once.
std::vector<VariableId> observed(const RunOptions& options) {
  std::vector<VariableId> ids = options.recorded;
  ids.insert(ids.end(), options.watched.begin(), options.watched.end());
  std::ranges::sort(ids);
  ids.erase(std::ranges::unique(ids).begin(), ids.end());
  return ids;
}

}  // namespace

class Simulation::Run {
 public:
  Run(const System& system, std::vector<std::unique_ptr<Unit>> units, RunOptions options)
      : system_(system),
        units_(std::move(units)),
        options_(std::move(options)),
        step_size_(system, options_),
        observed_(observed(options_)),
        outputs_(system, observed_),
        exchange_(system, outputs_.sources()),
        inputs_(make_inputs()),
        statistics_{.units = std::vector<UnitStatistics>(units_.size())},
        ledger_(make_ledger()),
        clock_(options_.measure_time),
        instant_(system, units_, exchange_, observers_, activities_, statistics_, clock_,
                 ledger_ ? &*ledger_ : nullptr),
        stepper_(system, units_, exchange_, statistics_.units, activities_, clock_, options_,
                 options_.sets_inputs_in_steps() ? &*inputs_ : nullptr,
                 ledger_ ? &*ledger_ : nullptr) {
    statistics_.start = statistics_.reached = options_.start;
    outputs_.connect(exchange_);
    if (options_.sets_inputs_in_steps()) lead_inputs_within_steps();
  }

  void add_observer(Observer& observer) { add_observer(observer, options_.recorded); }
  void add_observer(Observer& observer, std::vector<VariableId> signals) {
    const auto is_read = [&](VariableId id) { return std::ranges::binary_search(observed_, id); };
    if (!std::ranges::all_of(signals, is_read)) {
      throw std::logic_error("an observer wants a signal that is not read");
    }
    observers_.push_back(&observer);
    wanted_.push_back(std::move(signals));
    activities_.add(observer);
  }
  const RunStatistics& statistics() const { return statistics_; }
  Duration rested() const { return ledger_ ? ledger_->rested(time_) : Duration{}; }
  std::span<const Verdict> verdicts() const { return verdicts_; }

  void run() {
    if (std::exchange(has_run_, true)) throw std::logic_error("a simulation runs once");
    const auto began = WallClock::Source::now();
    std::exception_ptr failure;
    try {
      clock_.timed(statistics_.phases.initialization, [&] { initialize(); });
      while (goes_on()) communication_step();
      if (ledger_) ledger_->settle(time_);
      if (statistics_.end != RunEnd::Interrupted) verdicts_ = read_verdicts(system_, units_);
      for (auto& unit : units_) unit->terminate();
    } catch (...) {
      failure = std::current_exception();
    }
    statistics_.wall_time = WallClock::Source::now() - began;
    for (std::size_t i = 0; i < count(); ++i) {
      auto* const diagnostics = units_[i]->capability<UnitDiagnostics>();
      auto* const process = units_[i]->capability<OwnProcess>();
      if (diagnostics != nullptr) statistics_.units[i].calls = diagnostics->calls();
      if (process != nullptr) statistics_.units[i].host = process->host_statistics();
      statistics_.units[i].steps = stepper_.steps(i) + statistics_.units[i].rests;
    }
    finish_rests(failure);
    finish_observers(failure);
    if (!failure) return;
    verdicts_.clear();
    std::rethrow_exception(failure);
  }

 private:
  std::size_t count() const { return units_.size(); }

  void finish_rests(std::exception_ptr& failure) {
    if (!ledger_ || !failure) return;
    try {
      ledger_->tell_unfinished_rests(time_);
    } catch (...) {  // the first failure is kept
    }
  }

  /// All are told, also where one of them fails; the first failure is kept.
  void finish_observers(std::exception_ptr& failure) {
    for (Observer* observer : observers_) {
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
    if (ledger_) ledger_->enable();
    for (std::size_t i = 0; i < count(); ++i) {
      clock_.timed(statistics_.units[i].initialization_time,
                   [&] { units_[i]->enter_initialization(options_.start, options_.stop); });
    }
    set_initial_values(system_, units_, exchange_,
                       {clock_, statistics_.units, &UnitStatistics::initialization_time}, time_);
    for (std::size_t i = 0; i < count(); ++i) exchange_.begin_samples(i, *units_[i]);
    instant_.begin_clocks(time_);
    for (std::size_t i = 0; i < count(); ++i) {
      clock_.timed(statistics_.units[i].initialization_time,
                   [&] { units_[i]->exit_initialization(); });
    }
    start_observers();
    instant_.begin();
    settle();
    tell_observers();
  }

  void tell_observers() {
    outputs_.update();
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// Structural parameters; they give arrays their sizes, so they come first.
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

  void set(const StartValue& start) {
    units_[start.id.component]->set({&system_.variable(start.id).reference, 1}, start.value);
  }

  void start_observers() {
    for (std::size_t i = 0; i < observers_.size(); ++i) {
      std::vector<Signal> signals;
      for (const VariableId id : wanted_[i]) signals.push_back(outputs_.signal(id, exchange_));
      observers_[i]->on_start(signals);
    }
  }

  /// Nothing where nobody would use it.
  std::optional<StepInputs> make_inputs() {
    if (!options_.sets_inputs_in_steps() && !step_size_.controls_error()) return std::nullopt;
    return StepInputs(system_, exchange_, options_.coupling, options_.extrapolation);
  }

  std::optional<IdleLedger> make_ledger() {
    if (!options_.may_skip_idle_time()) return std::nullopt;
    std::optional<IdleLedger> ledger(std::in_place, system_, units_, exchange_, statistics_.units,
                                     activities_, options_.idle);
    if (ledger->is_trivial()) ledger.reset();
    return ledger;
  }

  void lead_inputs_within_steps() {
    for (std::size_t i = 0; i < count(); ++i) {
      Unit& unit = *units_[i];
      auto* const inputs = unit.capability<InputsWithinStep>();
      if (inputs == nullptr) continue;
      inputs->set_input_update(
          [this, i, &unit](double seconds) { inputs_->within_step(i, unit, seconds); });
    }
  }

  bool goes_on() {
    if (time_ >= options_.stop || statistics_.end == RunEnd::EndedByUnit) return false;
    if (options_.interrupted == nullptr || *options_.interrupted == 0) [[likely]]
      return true;
    statistics_.end = RunEnd::Interrupted;
    return false;
  }

  void communication_step() {
    const Time reached = clock_.timed(statistics_.phases.steps, [&] { return advance(); });
    if (reached == time_) {
      note_stall();
    } else {
      stalled_steps_ = 0;
    }
    time_ = reached;
    if (stepper_.has_requests()) take_requests();
    clock_.timed(statistics_.phases.instants, [&] { settle(); });
    ++statistics_.communication_steps;
    statistics_.parallel_steps += stepper_.was_parallel();
    statistics_.reached = time_;
    clock_.timed(statistics_.phases.observers, [&] { tell_observers(); });
  }

  void take_requests() {
    for (std::size_t i = 0; i < count(); ++i) {
      const StepResult& result = stepper_.result(i);
      if (result.terminate) statistics_.end = RunEnd::EndedByUnit;
      if (result.event_needed) instant_.request_event(i);
    }
  }

  /// Takes all units to the next communication point, as far as its errors are tolerable.
  Time advance() {
    while (true) {
      const Time reached = stepper_.advance(time_, next_target());
      if (!step_size_.controls_error()) return reached;
      const Excess excess = inputs_->excess(reached, options_.step.absolute_tolerance,
                                            options_.step.relative_tolerance);
      if (step_size_.accept(time_, reached, excess)) return reached;
      stepper_.undo(time_);
      ++statistics_.undone_steps;
    }
  }

  /// Where the policy leads to, unless an event is nearer.
  Time next_target() {
    const std::optional<Time> rest = ledger_ ? ledger_->all_rest_until() : std::nullopt;
    const Time target = rest ? step_size_.stride(time_, *rest) : step_size_.next(time_);
    return std::min(target, instant_.next_event().value_or(target));
  }

  void settle() {
    instant_.settle(time_);
    if (inputs_) inputs_->accept(time_, instant_.had_event());
  }

  void note_stall() {
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

  const System& system_;
  std::vector<std::unique_ptr<Unit>> units_;
  RunOptions options_;
  StepSize step_size_;
  std::vector<VariableId> observed_;  ///< sorted
  SystemOutputs outputs_;
  Exchange exchange_;
  std::optional<StepInputs> inputs_;
  std::vector<Observer*> observers_;
  std::vector<std::vector<VariableId>> wanted_;  ///< the signals of each of them
  Activities activities_;
  RunStatistics statistics_;
  std::vector<Verdict> verdicts_;
  std::optional<IdleLedger> ledger_;  ///< nothing where nobody may rest
  WallClock clock_;
  Instant instant_;
  Stepper stepper_;

  bool has_run_ = false;
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

Duration Simulation::rested() const { return run_->rested(); }

const RunStatistics& Simulation::statistics() const { return run_->statistics(); }

std::span<const Verdict> Simulation::verdicts() const { return run_->verdicts(); }

}  // namespace stride::core
