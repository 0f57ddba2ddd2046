// Whether a unit that decorates another one forwards everything.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_FORWARDING_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_FORWARDING_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/unit_capabilities.h"

namespace stride::tests {

/// A unit that has every capability, also those that are added later, and writes down the functions
/// that are called.
class CompleteUnit final : public core::Unit,
                           public core::ConfigurationMode,
                           public core::StateSaving,
                           public core::StateSerialization,
                           public core::Resetting,
                           public core::IdlePromises,
                           public core::DirectionalDerivatives,
                           public core::ClockIntervals,
                           public core::InputsWithinStep,
                           public core::MessageText,
                           public core::UnitDiagnostics,
                           public core::HostDiagnostics,
                           public core::ConcurrentSteps {
 public:
  using Calls = std::vector<std::string>;
  explicit CompleteUnit(Calls& calls) : called_(calls) {}

  void enter_initialization(Time, std::optional<Time>) override { note("enter_initialization"); }
  void exit_initialization() override { note("exit_initialization"); }
  void get(std::span<const core::ValueReference>, core::ValueBlock&) override { note("get"); }
  void set(std::span<const core::ValueReference>, const core::ValueBlock&) override { note("set"); }
  core::StepResult step(const core::StepInterval& interval) override {
    note("step");
    return {.early_return = true, .reached = interval.from};
  }
  core::StepResult step(const core::StepInterval& interval, const core::StepValues&) override {
    note("step with values");
    return {.early_return = true, .reached = interval.from};
  }
  void enter_event_mode() override { note("enter_event_mode"); }
  core::EventResult update_discrete_states() override {
    note("update_discrete_states");
    return {.discrete_states_need_update = true,
            .terminate_simulation = true,
            .next_event_time = Time::max()};
  }
  void enter_step_mode() override { note("enter_step_mode"); }
  void terminate() override { note("terminate"); }
  void free() override { note("free"); }

  void enter_configuration_mode() override { note("enter_configuration_mode"); }
  void exit_configuration_mode() override { note("exit_configuration_mode"); }
  void save_state() override { note("save_state"); }
  void restore_state() override { note("restore_state"); }
  void select_state(std::size_t) override { note("select_state"); }
  std::vector<std::uint8_t> serialize_state() override { return note("serialize_state"), Bytes{7}; }
  void deserialize_state(std::span<const std::uint8_t>) override { note("deserialize_state"); }
  void reset() override { note("reset"); }
  void enable_idle_skipping(Duration) override { note("enable_idle_skipping"); }
  void set_idle_tolerances(std::span<const core::ValueReference>,
                           std::span<const double>) override {
    note("set_idle_tolerances");
  }
  Time idle_until() override { return note("idle_until"), Time::max(); }
  void get_derivatives(std::span<const core::ValueReference>, std::span<double>) override {
    note("get_derivatives");
  }
  void get_directional_derivative(std::span<const core::ValueReference>,
                                  std::span<const core::ValueReference>, std::span<const double>,
                                  std::span<double>) override {
    note("get_directional_derivative");
  }
  core::ClockInterval clock_interval(const core::Variable&) override {
    return note("clock_interval"), core::ClockInterval{core::ClockInterval::State::Changed, {}};
  }
  core::Interval clock_shift(const core::Variable&) override { return note("clock_shift"), kShift; }
  void set_input_update(core::InputUpdate) override { note("set_input_update"); }
  std::string describe_message(core::ValueReference, const core::Binary&) override {
    return note("describe_message"), "a message";
  }
  std::string rejection_reason() const override { return note("rejection_reason"), "a reason"; }
  std::uint64_t calls() const override { return note("calls"), 5; }
  core::HostStatistics host_statistics() const override {
    return note("host_statistics"), core::HostStatistics{.snapshots = 3};
  }
  void begin_step(const core::StepInterval&, const core::StepValues&, const Extras&) override {
    note("begin_step");
  }
  core::StepResult finish_step() override { return note("finish_step"), core::StepResult{}; }
  std::chrono::nanoseconds step_time() const override { return note("step_time"), kStepTime; }

  static constexpr std::chrono::nanoseconds kStepTime{7};
  static inline const core::Interval kShift = core::Interval::from_fraction(1, 3);

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Unknown final : core::Capability {};

  core::Capability* find_capability(core::CapabilityId id) override {
    core::Capability* const known =
        core::select_capability<core::ConfigurationMode, core::StateSaving,
                                core::StateSerialization, core::Resetting, core::IdlePromises,
                                core::DirectionalDerivatives, core::ClockIntervals,
                                core::InputsWithinStep, core::MessageText, core::UnitDiagnostics,
                                core::HostDiagnostics, core::ConcurrentSteps>(*this, id);
    return known != nullptr ? known : &unknown_;
  }
  void note(const char* function) const { called_.emplace_back(function); }

  Calls& called_;
  Unknown unknown_;
};

/// A unit with what each unit has, and nothing else.
class PlainUnit final : public core::Unit {
 public:
  void enter_initialization(Time, std::optional<Time>) override {}
  void exit_initialization() override {}
  void get(std::span<const core::ValueReference>, core::ValueBlock&) override {}
  void set(std::span<const core::ValueReference>, const core::ValueBlock&) override {}
  core::StepResult step(const core::StepInterval& to) override { return {.reached = to.to}; }
  void enter_event_mode() override {}
  core::EventResult update_discrete_states() override { return {}; }
  void enter_step_mode() override {}
  void terminate() override {}
};

/// The capabilities that a unit has.
inline std::set<std::size_t> capability_numbers(core::Unit& unit) {
  std::set<std::size_t> numbers;
  for (std::size_t i = 0; i < core::kCapabilities; ++i) {
    if (unit.capability(static_cast<core::CapabilityId>(i)) != nullptr) numbers.insert(i);
  }
  return numbers;
}

/// The capabilities of a decorator are those of a unit that has all, without the `hidden` ones.
inline void check_capabilities(core::Unit& decorator, std::set<core::CapabilityId> hidden = {}) {
  for (std::size_t i = 0; i < core::kCapabilities; ++i) {
    const auto id = static_cast<core::CapabilityId>(i);
    CAPTURE(i);
    CHECK((decorator.capability(id) == nullptr) == hidden.contains(id));
  }
}

/// Each function that every unit has reaches the unit, which is a CompleteUnit that writes into
/// `calls`, and its answer comes back.
inline void check_functions(core::Unit& decorator, CompleteUnit::Calls& calls) {
  calls.clear();
  core::ValueBlock none(core::ValueType::Float64, 0);
  const core::StepInterval interval{Time(Duration(1)), Time(Duration(2))};
  decorator.set({}, none);
  decorator.enter_initialization(Time(Duration(1)), std::nullopt);
  decorator.exit_initialization();
  CHECK(decorator.update_discrete_states().next_event_time == Time::max());
  decorator.enter_step_mode();
  CHECK(decorator.step(interval).reached == interval.from);
  CHECK(decorator.step(interval, {}).reached == interval.from);
  decorator.enter_event_mode();
  decorator.get({}, none);
  decorator.terminate();
  decorator.free();
  CHECK(calls == CompleteUnit::Calls{"set", "enter_initialization", "exit_initialization",
                                     "update_discrete_states", "enter_step_mode", "step",
                                     "step with values", "enter_event_mode", "get", "terminate",
                                     "free"});
}

/// Likewise those of the capabilities that a decorator has an implementation of its own of.
inline void check_state_saving(core::Unit& decorator, CompleteUnit::Calls& calls) {
  calls.clear();
  state(decorator).save_state();
  state(decorator).restore_state();
  CHECK(calls == CompleteUnit::Calls{"save_state", "restore_state"});
}

inline void check_idle_promises(core::Unit& decorator, CompleteUnit::Calls& calls) {
  calls.clear();
  idle(decorator).enable_idle_skipping(Duration(1));
  idle(decorator).set_idle_tolerances({}, {});
  CHECK(idle(decorator).idle_until() == Time::max());
  idle(decorator).get_derivatives({}, {});
  CHECK(calls == CompleteUnit::Calls{"enable_idle_skipping", "set_idle_tolerances", "idle_until",
                                     "get_derivatives"});
}

}  // namespace stride::tests

#endif
