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
#include "master/algorithm/events/event_handler.h"
#include "master/algorithm/exchange/exchange.h"
#include "master/algorithm/exchange/system_outputs.h"
#include "master/algorithm/idle/idle_scheduler.h"
#include "master/algorithm/loops/initial_values.h"
#include "master/algorithm/stepping/input_extrapolator.h"
#include "master/algorithm/stepping/step_size_controller.h"
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
        inputs_(make_input_extrapolator()),
        statistics_{.units = std::vector<UnitStatistics>(units_.size())},
        idle_(make_idle_scheduler()),
        clock_(options_.measure_time),
        event_handler_(system, units_, exchange_, observers_, activities_, statistics_, clock_,
                       idle_ ? &*idle_ : nullptr),
        stepper_(system, units_, exchange_, statistics_.units, activities_, clock_, options_,
                 options_.sets_inputs_in_steps() ? &*inputs_ : nullptr, idle_ ? &*idle_ : nullptr) {
    statistics_.start = statistics_.reached = options_.start;
    outputs_.connect(exchange_);
    if (options_.sets_inputs_in_steps()) connect_input_updates();
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
  Duration suspended_time() const { return idle_ ? idle_->suspended_time(time_) : Duration{}; }
  std::span<const Verdict> verdicts() const { return verdicts_; }

  void run() {
    if (std::exchange(has_run_, true)) throw std::logic_error("a simulation runs once");
    const auto began = WallClock::Source::now();
    std::exception_ptr failure;
    try {
      clock_.timed(statistics_.phases.initialization, [&] { initialize(); });
      while (should_continue()) communication_step();
      if (idle_) idle_->catch_up_all(time_);
      if (statistics_.end != RunEnd::Interrupted) verdicts_ = read_verdicts(system_, units_);
      for (auto& unit : units_) unit->terminate();
    } catch (...) {
      failure = std::current_exception();
    }
    statistics_.wall_time = WallClock::Source::now() - began;
    for (std::size_t i = 0; i < count(); ++i) {
      statistics_.units[i].calls = units_[i]->calls();
      statistics_.units[i].host = units_[i]->host_statistics();
      statistics_.units[i].steps = stepper_.steps(i) + statistics_.units[i].suspensions;
    }
    finish_suspensions(failure);
    finish_observers(failure);
    if (!failure) return;
    verdicts_.clear();
    std::rethrow_exception(failure);
  }

 private:
  std::size_t count() const { return units_.size(); }

  void finish_suspensions(std::exception_ptr& failure) {
    if (!idle_ || !failure) return;
    try {
      idle_->report_unfinished(time_);
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
    if (idle_) idle_->enable();
    for (std::size_t i = 0; i < count(); ++i) {
      clock_.timed(statistics_.units[i].initialization_time,
                   [&] { units_[i]->enter_initialization(options_.start, options_.stop); });
    }
    set_initial_values(system_, units_, exchange_,
                       {clock_, statistics_.units, &UnitStatistics::initialization_time}, time_);
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
    outputs_.update();
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// Structural parameters; they give arrays their sizes, so they come first.
  void configure() {
    const std::span<const StartValue> all = system_.structural_values();
    for (auto first = all.begin(); first != all.end();) {
      Unit& unit = *units_[first->id.component];
      const auto last = std::find_if(first, all.end(), [&](const StartValue& value) {
        return value.id.component != first->id.component;
      });
      unit.enter_configuration_mode();
      std::for_each(first, last, [&](const StartValue& value) { set(value); });
      unit.exit_configuration_mode();
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
  std::optional<InputExtrapolator> make_input_extrapolator() {
    if (!options_.sets_inputs_in_steps() && !step_size_.controls_error()) return std::nullopt;
    return InputExtrapolator(system_, exchange_, options_.coupling, options_.extrapolation);
  }

  std::optional<IdleScheduler> make_idle_scheduler() {
    if (!options_.may_skip_idle_time()) return std::nullopt;
    std::optional<IdleScheduler> idle(std::in_place, system_, units_, exchange_, statistics_.units,
                                      activities_, options_.idle);
    if (idle->is_trivial()) idle.reset();
    return idle;
  }

  void connect_input_updates() {
    for (std::size_t i = 0; i < count(); ++i) {
      Unit& unit = *units_[i];
      unit.set_input_update(
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
    if (reached == time_) {
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
      if (result.terminate) statistics_.end = RunEnd::EndedByUnit;
      if (result.event_needed) event_handler_.request_event(i);
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
    const std::optional<Time> rest = idle_ ? idle_->all_suspended_until() : std::nullopt;
    const Time target = rest ? step_size_.stride(time_, *rest) : step_size_.next(time_);
    return std::min(target, event_handler_.next_event().value_or(target));
  }

  void handle_events() {
    event_handler_.handle_events(time_);
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

  const System& system_;
  std::vector<std::unique_ptr<Unit>> units_;
  RunOptions options_;
  StepSizeController step_size_;
  std::vector<VariableId> observed_;  ///< sorted
  SystemOutputs outputs_;
  Exchange exchange_;
  std::optional<InputExtrapolator> inputs_;
  std::vector<Observer*> observers_;
  std::vector<std::vector<VariableId>> wanted_;  ///< the signals of each of them
  Activities activities_;
  RunStatistics statistics_;
  std::vector<Verdict> verdicts_;
  std::optional<IdleScheduler> idle_;  ///< nothing where nobody may rest
  WallClock clock_;
  EventHandler event_handler_;
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

Duration Simulation::suspended_time() const { return run_->suspended_time(); }

const RunStatistics& Simulation::statistics() const { return run_->statistics(); }

std::span<const Verdict> Simulation::verdicts() const { return run_->verdicts(); }

}  // namespace stride::core
