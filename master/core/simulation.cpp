#include "master/core/simulation.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "master/core/exchange.h"
#include "master/core/messages.h"
#include "master/core/stepper.h"

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
        statistics_{.units = std::vector<UnitStatistics>(units_.size())},
        stepper_(system, units_, statistics_.units,
                 {options_.step, options_.minimum_step, options_.measure_time}),
        active_(units_.size()),
        in_event_mode_(units_.size()),
        polled_(units_.size()),
        next_event_(units_.size()) {
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
    settle();
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// Outputs reach inputs until nothing changes. Without a loop a value crosses each connection
  /// once, so it takes no more passes than there are connections.
  void propagate_initial_values() {
    std::vector<VariableId> changed;
    for (std::size_t pass = 0; pass <= system_.connections().size() + 1; ++pass) {
      for (std::size_t i = 0; i < count(); ++i) {
        timed(statistics_.units[i].initialization_time, [&] { exchange_.fetch(i, *units_[i]); });
      }
      changed = exchange_.route_and_compare();
      if (changed.empty() && pass > 0) return exchange_.check_nan(time_);
      for (std::size_t i = 0; i < count(); ++i) exchange_.deliver(i, *units_[i]);
    }
    std::string names;
    for (const VariableId id : changed) {
      names += (names.empty() ? "'" : ", '") + system_.full_name(id) + "'";
    }
    fail_run({{}, {}, {}, time_},
             fmt::format("the initial values do not settle: units feed each other in an algebraic "
                         "loop, through the inputs {}",
                         names),
             "give one of the units in the loop an output that does not depend on its input");
  }

  void start_observers() {
    std::vector<Signal> signals;
    for (const VariableId id : options_.recorded) signals.push_back(exchange_.signal(id));
    for (Observer* observer : observers_) observer->on_start(signals);
  }

  void communication_step() {
    const Time reached = stepper_.advance(time_, next_target());
    note_progress(reached);
    time_ = reached;
    for (std::size_t i = 0; i < count(); ++i) {
      const StepResult& result = stepper_.result(i);
      statistics_.terminated_by_unit |= result.terminate;
      active_[i] = result.event_needed || (next_event_[i] && *next_event_[i] <= time_);
    }
    settle();
    ++statistics_.communication_steps;
    statistics_.reached = time_;
    for (Observer* observer : observers_) observer->on_communication_point(time_);
  }

  /// The next point of the grid, unless an event or the end is nearer.
  Time next_target() const {
    Time target = options_.stop;
    const Duration since = (time_ - options_.start) % options_.step;
    if (options_.stop - time_ > options_.step - since) target = time_ + (options_.step - since);
    for (const std::optional<Time>& event : next_event_) {
      if (event && *event > time_) target = std::min(target, *event);
    }
    return target;
  }

  void note_progress(Time reached) {
    stalled_steps_ = reached > time_ ? 0 : stalled_steps_ + 1;
    if (stalled_steps_ < kEventLimit) return;
    std::string names;
    for (std::size_t i = 0; i < count(); ++i) {
      if (stepper_.result(i).early_return) add_name(names, i);
    }
    fail_run(
        {{}, {}, {}, time_},
        fmt::format("{} steps in a row ended where they began, because these units stopped: {}",
                    kEventLimit, names));
  }

  /// Exchanges values and handles events at the present instant until nothing wants another round.
  /// `active_` says who has an event; at the start the units are in Event Mode already.
  void settle() {
    for (std::size_t i = 0; i < count(); ++i) exchange_.fetch(i, *units_[i]);
    route();
    for (std::uint32_t index = 0; prepare_events(); ++index) {
      if (index == kEventLimit) fail_ticking();
      event_iteration(index);
      for (std::size_t i = 0; i < count(); ++i) {
        if (in_event_mode_[i]) exchange_.fetch(i, *units_[i]);
      }
      route();
    }
    for (std::size_t i = 0; i < count(); ++i) {
      if (!in_event_mode_[i]) continue;
      units_[i]->enter_step_mode();
      in_event_mode_[i] = false;
    }
  }

  void route() {
    exchange_.check_nan(time_);
    exchange_.route();
  }

  /// Delivers all inputs; units that have an event, or an input that changes discretely, are in
  /// Event Mode then. Tells whether there are any.
  bool prepare_events() {
    bool any = false;
    for (std::size_t i = 0; i < count(); ++i) {
      if (exchange_.has_discrete_change(i) && description(i).has_event_mode) active_[i] = true;
      if (active_[i]) enter_event_mode(i);
      any |= static_cast<bool>(active_[i]);
      exchange_.deliver(i, *units_[i]);
    }
    return any;
  }

  void enter_event_mode(std::size_t i) {
    if (in_event_mode_[i]) return;
    units_[i]->enter_event_mode();
    in_event_mode_[i] = true;
  }

  /// One super-dense instant: messages, then the units' discrete states. Leaves in `active_` who
  /// wants another.
  void event_iteration(std::uint32_t index) {
    ++statistics_.event_iterations;
    exchange_messages(index);
    for (std::size_t i = 0; i < count(); ++i) {
      if (!in_event_mode_[i]) continue;
      const EventResult result = timed(statistics_.units[i].event_time,
                                       [&] { return units_[i]->update_discrete_states(); });
      ++statistics_.units[i].events;
      statistics_.terminated_by_unit |= result.terminate;
      next_event_[i] = result.next_event;
      active_[i] = result.iterate;
    }
  }

  /// A clock that is set may make the receiver's own clocks tick at once, so receivers are asked
  /// again.
  void exchange_messages(std::uint32_t index) {
    messages_.begin_instant();
    polled_ = in_event_mode_;
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < count(); ++i) {
        if (!polled_[i]) continue;
        polled_[i] = false;
        again = true;
        transmit(i, index);
      }
    }
  }

  void transmit(std::size_t sender, std::uint32_t index) {
    messages_.transmit(
        sender,
        [&](std::size_t receiver) {
          enter_event_mode(receiver);
          polled_[receiver] = true;
        },
        [&](VariableId id, bool received, const ValueBlock* block) {
          UnitStatistics& statistics = statistics_.units[id.component];
          ++(received ? statistics.messages_received : statistics.messages_sent);
          const Message message{time_, index, id, received, block, 0};
          for (Observer* observer : observers_) observer->on_message(message);
        });
  }

  void add_name(std::string& names, std::size_t i) const {
    names += (names.empty() ? "'" : ", '") + system_.components()[i].name + "'";
  }

  [[noreturn]] void fail_ticking() const {
    std::string names;
    for (std::size_t i = 0; i < count(); ++i) {
      if (active_[i]) add_name(names, i);
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
  Stepper stepper_;

  Time time_{};
  std::uint32_t stalled_steps_ = 0;
  std::vector<char> active_;  ///< wants the next event iteration
  std::vector<char> in_event_mode_;
  std::vector<char> polled_;  ///< its output clocks are to be read
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
