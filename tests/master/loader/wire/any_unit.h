// A unit with every capability that goes over the wire; it notes its calls, as text.
#ifndef STRIDE_TESTS_MASTER_LOADER_WIRE_ANY_UNIT_H
#define STRIDE_TESTS_MASTER_LOADER_WIRE_ANY_UNIT_H

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/loader/wire/unit_proxy.h"

namespace stride::tests {

/// Two inputs `in` in an array, an output `out`, a text and a clock, with the references 0 to 3.
inline core::UnitDescription any_description() {
  core::UnitDescription unit;
  unit.variables.resize(4);
  for (core::ValueReference i = 0; i < 4; ++i) unit.variables[i].reference = i;
  unit.variables[0].size = 2;
  unit.variables[2].type = core::ValueType::String;
  unit.variables[3].type = core::ValueType::Clock;
  return unit;
}

class AnyUnit final : public core::Unit, public isolation::ProxyCapabilities {
 public:
  using References = std::span<const core::ValueReference>;

  std::vector<std::string> log;
  core::StepResult result{};  ///< of each step
  core::InputUpdate update;   ///< as it was set
  double output = 0;          ///< what is read of each number

  void enter_configuration_mode() override { log.emplace_back("enter_configuration_mode"); }
  void exit_configuration_mode() override { log.emplace_back("exit_configuration_mode"); }
  void enter_initialization(Time start, std::optional<Time> stop) override {
    note("enter_initialization {} {}", ps(start), stop ? ps(*stop) : -1);
  }
  void exit_initialization() override { log.emplace_back("exit_initialization"); }
  void get(References references, core::ValueBlock& values) override {
    note("get {}", references);
    core::visit(values, [&]<class T>(std::span<T> elements) {
      for (T& element : elements) {
        if constexpr (std::is_arithmetic_v<T>) element = static_cast<T>(output);
        if constexpr (std::is_same_v<T, std::string>) element = "read";
      }
    });
  }
  void set(References references, const core::ValueBlock& values) override {
    note("set {} {}", references, core::elements_text(values));
  }
  core::StepResult step(const core::StepInterval& interval) override {
    note("step {} {} {} {}", ps(interval.from), ps(interval.to), interval.size_seconds,
         interval.may_go_back_before);
    if (update) update(0.5);
    return result;
  }
  void enter_event_mode() override { log.emplace_back("enter_event_mode"); }
  core::EventResult update_discrete_states() override { return {true, false, Time(Duration(7))}; }
  void enter_step_mode() override { log.emplace_back("enter_step_mode"); }
  void terminate() override { log.emplace_back("terminate"); }
  void free() override { log.emplace_back("free"); }
  void save_state() override { log.emplace_back("save_state"); }
  void restore_state() override { log.emplace_back("restore_state"); }
  void select_state(std::size_t slot) override { note("select_state {}", slot); }
  std::vector<std::uint8_t> serialize_state() override { return {1, 2, 3}; }
  void deserialize_state(std::span<const std::uint8_t> bytes) override {
    note("deserialize_state {}", bytes);
  }
  void reset() override { log.emplace_back("reset"); }
  core::ClockInterval clock_interval(const core::Variable& clock) override {
    note("clock_interval {}", clock.reference);
    return {core::ClockInterval::State::Changed, core::Interval::from_fraction(1, 3)};
  }
  core::Interval clock_shift(const core::Variable& clock) override {
    note("clock_shift {}", clock.reference);
    return core::Interval::from_fraction(1, 7);
  }
  void get_directional_derivative(References unknowns, References knowns,
                                  std::span<const double> seed,
                                  std::span<double> sensitivity) override {
    note("get_directional_derivative {} {} {}", unknowns, knowns, seed);
    std::ranges::fill(sensitivity, output);
  }
  void set_input_update(core::InputUpdate function) override { update = std::move(function); }
  void enable_idle_skipping(Duration max) override { note("enable_idle_skipping {}", max.count()); }
  void set_idle_tolerances(References outputs, std::span<const double> tolerances) override {
    note("set_idle_tolerances {} {}", outputs, tolerances);
  }
  Time idle_until() override { return Time(Duration(11)); }
  void get_derivatives(References outputs, std::span<double> derivatives) override {
    note("get_derivatives {}", outputs);
    std::ranges::fill(derivatives, output);
  }
  std::string describe_message(core::ValueReference variable, const core::Binary& value) override {
    return fmt::format("{} has {}", variable, value);
  }
  std::string rejection_reason() const override { return "too far"; }
  std::uint64_t calls() const override { return log.size(); }
  void set_repeating(bool repeating) override { note("set_repeating {}", repeating); }
  core::HostStatistics host_statistics() const override { return {.most_memory = 5}; }
  void begin_step(const core::StepInterval&, const core::StepValues&, const Extras&) override {}
  core::StepResult finish_step() override { return result; }
  std::chrono::nanoseconds step_time() const override { return {}; }

 private:
  template <class... Parts>
  void note(fmt::format_string<Parts...> text, Parts&&... parts) {
    log.push_back(fmt::format(text, std::forward<Parts>(parts)...));
  }
  static std::int64_t ps(Time time) { return time.time_since_epoch().count(); }
  core::Capability* find_capability(core::CapabilityId id) override { return implemented(id); }
};

}  // namespace stride::tests

#endif
