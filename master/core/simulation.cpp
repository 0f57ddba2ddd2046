#include "master/core/simulation.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "master/core/exchange.h"
#include "master/core/messages.h"

namespace stride::core {
namespace {

using WallClock = std::chrono::steady_clock;

/// Event iterations at one instant after which units are taken to tick for ever.
constexpr std::uint32_t kEventLimit = 1000;

}  // namespace

class Simulation::Run {
 public:
  Run(const System& system, std::vector<std::unique_ptr<Unit>> units, RunOptions options)
      : system_(system),
        units_(std::move(units)),
        options_(std::move(options)),
        exchange_(system, options_.recorded),
        messages_(system, units_),
        active_(units_.size()),
        in_event_mode_(units_.size()),
        next_event_(units_.size()) {
    statistics_.units.resize(units_.size());
    statistics_.start = statistics_.reached = options_.start;
  }

  void add_observer(Observer& observer) { observers_.push_back(&observer); }
  const RunStatistics& statistics() const { return statistics_; }

  void run() {
    const auto began = WallClock::now();
    std::exception_ptr failure;
    try {
      initialize();
      while (time_ < options_.stop && !statistics_.terminated_by_unit) communication_step();
      for (auto& unit : units_) unit->terminate();
    } catch (...) {
      failure = std::current_exception();
    }
    statistics_.wall_time = WallClock::now() - began;
    finish_observers(failure);
    if (failure) std::rethrow_exception(failure);
  }

 private:
  std::size_t count() const { return units_.size(); }
  const UnitDescription& description(std::size_t i) const {
    return *system_.components()[i].description;
  }

  /// Runs the action and adds its wall-clock time to the sum.
  template <class Action>
  decltype(auto) timed(std::chrono::nanoseconds& sum, Action&& action) {
    struct Adder {
      std::chrono::nanoseconds* sum;
      WallClock::time_point began;
      ~Adder() {
        if (sum != nullptr) *sum += WallClock::now() - began;
      }
    };
    const Adder adder = options_.measure_time ? Adder{&sum, WallClock::now()} : Adder{nullptr, {}};
    return action();
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
    for (const StartValue& start : system_.start_values()) {
      units_[start.id.component]->set({&system_.variable(start.id).reference, 1}, start.value);
    }
    for (std::size_t i = 0; i < count(); ++i) {
      timed(statistics_.units[i].initialization_time,
            [&] { units_[i]->enter_initialization(options_.start, options_.stop); });
    }
    propagate_initial_values();
    for (std::size_t i = 0; i < count(); ++i) {
      timed(statistics_.units[i].initialization_time, [&] { units_[i]->exit_initialization(); });
      active_[i] = in_event_mode_[i] = description(i).has_event_mode;
    }
    start_observers();
    iterate_events();
    exchange();
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// Outputs reach inputs until nothing changes: without a loop, one pass for each unit in the
  /// longest chain.
  void propagate_initial_values() {
    for (std::size_t pass = 0; pass <= count() + 1; ++pass) {
      for (std::size_t i = 0; i < count(); ++i) {
        timed(statistics_.units[i].initialization_time, [&] { exchange_.fetch(i, *units_[i]); });
      }
      const bool changed = exchange_.route_and_compare(time_);
      if (!changed && pass > 0) return;
      for (std::size_t i = 0; i < count(); ++i) exchange_.deliver(i, *units_[i]);
    }
    fail_run({{}, {}, {}, time_},
             "the initial values do not settle: units feed each other in an algebraic loop",
             "give one of the units in the loop an output that does not depend on its input");
  }

  void start_observers() {
    std::vector<Signal> signals;
    for (const VariableId id : options_.recorded) signals.push_back(exchange_.signal(id));
    for (Observer* observer : observers_) observer->on_start(signals);
  }

  void communication_step() {
    const Time next = std::min(time_ + options_.step, options_.stop);
    bool any_event = false;
    for (std::size_t i = 0; i < count(); ++i) {
      any_event |= step(i, next);
    }
    time_ = next;
    exchange();
    if (any_event) {
      handle_events();
      exchange();
    }
    ++statistics_.communication_steps;
    statistics_.reached = time_;
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// Tells whether the unit wants Event Mode at the end of the step.
  bool step(std::size_t i, Time next) {
    UnitStatistics& statistics = statistics_.units[i];
    const StepResult result =
        timed(statistics.step_time, [&] { return units_[i]->step(time_, next); });
    if (result.rejected || result.early_return) fail_step(i, next, result);
    ++statistics.steps;
    statistics_.terminated_by_unit |= result.terminate;
    active_[i] = result.event_needed || (next_event_[i] && *next_event_[i] <= next);
    return active_[i];
  }

  [[noreturn]] void fail_step(std::size_t i, Time next, const StepResult& result) const {
    const Context context{{}, system_.components()[i].name, {}, time_};
    fail_run(context,
             result.rejected
                 ? fmt::format("the unit rejected the step to {} s", to_text(next))
                 : fmt::format("the unit stopped at {} s on the way to {} s, although early return "
                               "is not allowed",
                               to_text(result.reached), to_text(next)),
             "try a smaller step size");
  }

  void exchange() {
    for (std::size_t i = 0; i < count(); ++i) exchange_.fetch(i, *units_[i]);
    exchange_.route(time_);
    for (std::size_t i = 0; i < count(); ++i) exchange_.deliver(i, *units_[i]);
  }

  void enter_event_mode(std::size_t i) {
    if (in_event_mode_[i]) return;
    units_[i]->enter_event_mode();
    in_event_mode_[i] = true;
  }

  void handle_events() {
    for (std::size_t i = 0; i < count(); ++i) {
      if (active_[i]) enter_event_mode(i);
    }
    iterate_events();
  }

  /// Super-dense instants at the present time, until no unit wants another.
  void iterate_events() {
    for (std::uint32_t index = 0; event_iteration(index); ++index) {
      if (index == kEventLimit) fail_ticking();
    }
    for (std::size_t i = 0; i < count(); ++i) {
      if (!in_event_mode_[i]) continue;
      units_[i]->enter_step_mode();
      in_event_mode_[i] = false;
    }
  }

  /// Tells whether another one is wanted.
  bool event_iteration(std::uint32_t index) {
    ++statistics_.event_iterations;
    for (std::size_t i = 0; i < count(); ++i) {
      if (active_[i]) transmit(i, index);
    }
    bool again = false;
    for (std::size_t i = 0; i < count(); ++i) {
      if (!in_event_mode_[i]) continue;
      const EventResult result = timed(statistics_.units[i].event_time,
                                       [&] { return units_[i]->update_discrete_states(); });
      ++statistics_.units[i].events;
      statistics_.terminated_by_unit |= result.terminate;
      next_event_[i] = result.next_event;
      active_[i] = result.iterate;
      again |= result.iterate;
    }
    return again;
  }

  void transmit(std::size_t sender, std::uint32_t index) {
    messages_.transmit(
        sender, [&](std::size_t receiver) { enter_event_mode(receiver); },
        [&](VariableId id, bool received, const ValueBlock* block) {
          UnitStatistics& statistics = statistics_.units[id.component];
          ++(received ? statistics.messages_received : statistics.messages_sent);
          const Message message{time_, index, id, received, block, 0};
          for (Observer* observer : observers_) observer->on_message(message);
        });
  }

  [[noreturn]] void fail_ticking() const {
    std::string names;
    for (std::size_t i = 0; i < count(); ++i) {
      if (active_[i]) names += (names.empty() ? "'" : ", '") + system_.components()[i].name + "'";
    }
    fail_run({{}, {}, {}, time_},
             fmt::format("after {} event iterations at one instant these units still want another: "
                         "{}",
                         kEventLimit, names),
             "look for messages that answer each other without any delay");
  }

  const System& system_;
  std::vector<std::unique_ptr<Unit>> units_;
  RunOptions options_;
  Exchange exchange_;
  MessageExchange messages_;
  std::vector<Observer*> observers_;
  RunStatistics statistics_;

  Time time_{};
  std::vector<char> active_;  ///< wants the next event iteration
  std::vector<char> in_event_mode_;
  std::vector<std::optional<Time>> next_event_;
};

Simulation::Simulation(const System& system, std::vector<std::unique_ptr<Unit>> units,
                       RunOptions options)
    : run_(std::make_unique<Run>(system, std::move(units), std::move(options))) {}

Simulation::~Simulation() = default;

void Simulation::add_observer(Observer& observer) { run_->add_observer(observer); }

void Simulation::run() { run_->run(); }

const RunStatistics& Simulation::statistics() const { return run_->statistics(); }

}  // namespace stride::core
