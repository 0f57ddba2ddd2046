// A unit in memory whose behaviour a test writes as a few lambdas over real value storage.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_SCRIPTED_UNIT_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_SCRIPTED_UNIT_H

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/unit.h"

namespace stride::core {

inline Variable make_variable(std::string name, ValueReference reference, ValueType type,
                              Causality causality) {
  Variable variable;
  variable.name = std::move(name);
  variable.reference = reference;
  variable.type = type;
  variable.causality = causality;
  const bool real = type == ValueType::Float64 || type == ValueType::Float32;
  variable.variability = causality == Causality::Parameter ? Variability::Fixed
                         : real                            ? Variability::Continuous
                                                           : Variability::Discrete;
  const bool given = causality == Causality::Parameter || causality == Causality::Input;
  variable.initial = type == ValueType::Clock ? Initial::None
                     : given                  ? Initial::Exact
                                              : Initial::Calculated;
  if (type == ValueType::Clock) variable.clock.emplace();
  return variable;
}

/// A description with variables numbered from 0.
class Describe {
 public:
  explicit Describe(std::string model) { description_->model_name = std::move(model); }

  Describe& add(const std::string& name, ValueType type, Causality causality,
                const std::string& unit = "") {
    const auto reference = static_cast<ValueReference>(description_->variables.size());
    description_->variables.push_back(make_variable(name, reference, type, causality));
    description_->variables.back().unit = unit;
    return *this;
  }
  Describe& input(const std::string& name, const std::string& unit = "") {
    return add(name, ValueType::Float64, Causality::Input, unit);
  }
  Describe& output(const std::string& name, const std::string& unit = "") {
    return add(name, ValueType::Float64, Causality::Output, unit);
  }
  /// A time-based input clock; without an interval the unit gives it.
  Describe& clock(const std::string& name, IntervalVariability variability,
                  std::optional<Interval> interval = std::nullopt, Interval shift = {}) {
    add(name, ValueType::Clock, Causality::Input);
    *description_->variables.back().clock = {variability, interval, shift, true, false, {}};
    description_->has_event_mode = true;
    return *this;
  }
  Describe& clocked_by(ValueReference clock) {
    description_->variables.back().clocks = {clock};
    description_->variables.back().variability = Variability::Discrete;
    description_->has_event_mode = true;
    return *this;
  }
  Describe& size(std::size_t elements) {
    description_->variables.back().dimensions = {elements};
    description_->variables.back().size = elements;
    return *this;
  }
  Describe& range(const std::string& min, const std::string& max) {
    description_->variables.back().min = min;
    description_->variables.back().max = max;
    return *this;
  }
  Describe& directional_derivatives() {
    description_->provides_directional_derivatives = true;
    return *this;
  }
  /// Of the output listed last; without it, nothing is declared.
  Describe& depends_on(std::vector<ValueReference> inputs) {
    description_->outputs.push_back({description_->variables.back().reference, std::move(inputs)});
    return *this;
  }
  Describe& depends_initially_on(std::vector<ValueReference> knowns) {
    description_->initial_unknowns.push_back(
        {description_->variables.back().reference, std::move(knowns)});
    return *this;
  }
  Describe& exact() {
    description_->variables.back().initial = Initial::Exact;
    return *this;
  }
  Describe& unit(const std::string& symbol, BaseUnitOfMeasure base) {
    description_->units_of_measure[symbol] = base;
    return *this;
  }
  Describe& event_mode() { return description_->has_event_mode = true, *this; }
  Describe& can_save_state() { return description_->can_save_state = true, *this; }
  Describe& may_return_early() { return description_->may_return_early = true, *this; }
  Describe& fixed_step() { return description_->can_vary_step = false, *this; }
  Describe& maximum_step(const Interval& step) { return description_->maximum_step = step, *this; }
  Describe& fixed_internal_step(const Interval& step) {
    return description_->fixed_internal_step = step, *this;
  }
  Describe& promises_idle() { return description_->promises_idle = true, *this; }
  /// Of the input listed last.
  Describe& deadband(double value) {
    description_->variables.back().deadband = value;
    return *this;
  }
  /// Of the output listed last.
  Describe& tolerance(double value) {
    description_->variables.back().tolerance = value;
    return *this;
  }
  Describe& allows_no_snapshots() { return description_->allows_snapshots = false, *this; }
  Describe& never_rejects() { return description_->may_reject = false, *this; }

  std::shared_ptr<const UnitDescription> done() const { return description_; }

 private:
  std::shared_ptr<UnitDescription> description_ = [] {
    auto description = std::make_shared<UnitDescription>();
    description->can_vary_step = true;
    return description;
  }();
};

/// With all capabilities that the scripts can fill; HostDiagnostics where `host` is set,
/// ConcurrentSteps where `is_concurrent` is.
class ScriptedUnit : public Unit,
                     public ConfigurationMode,
                     public StateSaving,
                     public IdlePromises,
                     public DirectionalDerivatives,
                     public ClockIntervals,
                     public MessageText,
                     public HostDiagnostics,
                     public ConcurrentSteps {
 public:
  using Calls = std::vector<std::string>;

  explicit ScriptedUnit(std::shared_ptr<const UnitDescription> description)
      : description_(std::move(description)) {
    for (const Variable& variable : description_->variables) {
      values_.emplace(variable.reference, ValueBlock(variable.type, variable.size));
    }
  }

  std::function<void(ScriptedUnit&)> on_initialize = [](ScriptedUnit&) {};
  /// Called before values are read in Event Mode: outputs that depend directly on inputs.
  std::function<void(ScriptedUnit&)> on_read_in_event_mode = [](ScriptedUnit&) {};
  std::function<StepResult(ScriptedUnit&, Time, Time)> on_step = [](ScriptedUnit&, Time, Time to) {
    StepResult result;
    result.reached = to;
    return result;
  };
  std::function<void(const StepInterval&)> on_interval = [](const StepInterval&) {};
  /// Called when an input clock is set.
  std::function<void(ScriptedUnit&)> on_set_clock = [](ScriptedUnit&) {};
  std::function<EventResult(ScriptedUnit&)> on_event = [](ScriptedUnit&) { return EventResult{}; };
  /// Its time-based clocks.
  std::function<ClockInterval(ScriptedUnit&, ValueReference)> on_clock_interval =
      [](ScriptedUnit&, ValueReference) { return ClockInterval{}; };
  std::function<Interval(ScriptedUnit&, ValueReference)> on_clock_shift =
      [](ScriptedUnit&, ValueReference) { return Interval{}; };
  /// What it promises, and the slopes of its outputs with tolerances.
  std::function<Time(ScriptedUnit&)> on_idle_until = [](ScriptedUnit&) { return Time::min(); };
  std::function<double(ScriptedUnit&, ValueReference)> on_slope =
      [](ScriptedUnit&, ValueReference) { return 0.0; };
  /// The derivatives of an unknown with respect to a known, each element of one by each of the
  /// other, row by row.
  std::function<std::vector<double>(ScriptedUnit&, ValueReference, ValueReference)> on_derivative;
  /// Its description of a message.
  std::function<std::string(ScriptedUnit&, ValueReference, const Binary&)> on_describe =
      [](ScriptedUnit&, ValueReference, const Binary&) { return std::string(); };
  std::optional<Duration> max_skip;  ///< as it was enabled
  /// Keeps or brings back what the script holds beside the values.
  std::function<void(ScriptedUnit&)> on_terminate = [](ScriptedUnit&) {};
  std::function<void(ScriptedUnit&)> on_free = [](ScriptedUnit&) {};
  std::function<void(bool save)> on_state = [](bool) {};
  std::optional<HostStatistics> host;  ///< about its process
  /// It takes its inputs where a step begins, and makes it where it is waited for.
  bool is_concurrent = false;
  std::function<void(ScriptedUnit&)> on_begin_step = [](ScriptedUnit&) {};
  std::chrono::nanoseconds time_of_step{1};  ///< as it says then
  std::optional<StepInterval> begun;         ///< and not finished
  bool saved_with_step = false;              ///< the last one
  Calls calls;
  int gets = 0;

  double& number(ValueReference reference) { return values_.at(reference).numbers<double>()[0]; }
  bool& clock(ValueReference reference) { return values_.at(reference).numbers<bool>()[0]; }
  Binary& binary(ValueReference reference) { return values_.at(reference).binaries()[0]; }
  ValueBlock& block(ValueReference reference) { return values_.at(reference); }

  void enter_configuration_mode() override {}
  void exit_configuration_mode() override {}
  void enter_initialization(Time, std::optional<Time>) override {
    calls.push_back("enter_initialization");
    initializing_ = true;
  }
  void exit_initialization() override {
    calls.push_back("exit_initialization");
    on_initialize(*this);
    initializing_ = false;
    in_event_mode_ = description_->has_event_mode;
  }
  void get(std::span<const ValueReference> references, ValueBlock& values) override {
    ++gets;
    if (initializing_) on_initialize(*this);
    if (in_event_mode_) on_read_in_event_mode(*this);
    move_values(references, values, [](auto& inside, auto& outside) { outside = inside; });
  }
  void set(std::span<const ValueReference> references, const ValueBlock& values) override {
    move_values(references, values, [](auto& inside, auto& outside) { inside = outside; });
    if (values.type() == ValueType::Clock) on_set_clock(*this);
  }
  StepResult step(const StepInterval& interval) override {
    on_interval(interval);
    return on_step(*this, interval.from, interval.to);
  }
  void begin_step(const StepInterval& interval, const StepValues& values,
                  const Extras& extras) override {
    if (begun) throw std::logic_error("a step has begun already");
    for (const BoundValues& input : values.inputs) set(input.references, *input.block);
    saved_with_step = extras.saves_state;
    if (saved_with_step) save_state();
    begun = interval;
    outputs_ = values.outputs;
    on_begin_step(*this);
  }
  StepResult finish_step() override {
    return Unit::step(*std::exchange(begun, std::nullopt), {{}, outputs_});
  }
  std::chrono::nanoseconds step_time() const override { return time_of_step; }
  void save_state() override {
    saved_values_ = values_;
    on_state(true);
  }
  void restore_state() override {
    values_ = saved_values_.value();
    on_state(false);
  }
  void select_state(std::size_t) override {
    throw std::logic_error("this kind of unit keeps one state only");
  }
  void enter_event_mode() override {
    calls.push_back("enter_event_mode");
    in_event_mode_ = true;
  }
  EventResult update_discrete_states() override {
    calls.push_back("update_discrete_states");
    const EventResult result = on_event(*this);
    for (const Variable& variable : description_->variables) {
      if (variable.type == ValueType::Clock && variable.causality == Causality::Input) {
        clock(variable.reference) = false;
      }
    }
    return result;
  }
  void enter_step_mode() override {
    calls.push_back("enter_step_mode");
    in_event_mode_ = false;
  }
  ClockInterval clock_interval(const Variable& clock) override {
    return on_clock_interval(*this, clock.reference);
  }
  Interval clock_shift(const Variable& clock) override {
    return on_clock_shift(*this, clock.reference);
  }
  void enable_idle_skipping(Duration skip) override {
    calls.push_back("enable_idle_skipping");
    max_skip = skip;
  }
  void set_idle_tolerances(std::span<const ValueReference> outputs,
                           std::span<const double> tolerances) override {
    calls.push_back(fmt::format("tolerance {} {}", outputs[0], tolerances[0]));
  }
  Time idle_until() override { return on_idle_until(*this); }
  void get_derivatives(std::span<const ValueReference> outputs,
                       std::span<double> derivatives) override {
    for (std::size_t i = 0; i < outputs.size(); ++i) derivatives[i] = on_slope(*this, outputs[i]);
  }
  void get_directional_derivative(std::span<const ValueReference> unknowns,
                                  std::span<const ValueReference> knowns,
                                  std::span<const double> seed,
                                  std::span<double> sensitivity) override {
    calls.push_back("get_directional_derivative");
    std::size_t row = 0;
    for (const ValueReference unknown : unknowns) {
      for (std::size_t i = 0; i < block(unknown).size(); ++i, ++row) {
        sensitivity[row] = 0;
        std::size_t column = 0;
        for (const ValueReference known : knowns) {
          const std::vector<double> derivatives = on_derivative(*this, unknown, known);
          const std::size_t size = block(known).size();
          for (std::size_t k = 0; k < size; ++k, ++column) {
            sensitivity[row] += derivatives[i * size + k] * seed[column];
          }
        }
      }
    }
  }
  std::string describe_message(ValueReference variable, const Binary& value) override {
    calls.push_back("describe_message");
    return on_describe(*this, variable, value);
  }
  void terminate() override {
    calls.push_back("terminate");
    on_terminate(*this);
  }
  void free() override { on_free(*this); }
  HostStatistics host_statistics() const override { return host.value(); }

 protected:
  Capability* find_capability(CapabilityId id) override {
    if (id == HostDiagnostics::kId && !host) return nullptr;
    if (id == ConcurrentSteps::kId && !is_concurrent) return nullptr;
    return select_capability<ConfigurationMode, StateSaving, IdlePromises, DirectionalDerivatives,
                             ClockIntervals, MessageText, HostDiagnostics, ConcurrentSteps>(*this,
                                                                                            id);
  }

 private:
  template <class Block, class Move>
  void move_values(std::span<const ValueReference> references, Block& outside, Move&& move) {
    std::size_t at = 0;
    for (const ValueReference reference : references) {
      ValueBlock& inside = values_.at(reference);
      visit(inside, [&](auto elements) {
        visit(outside, [&](auto others) {
          using A = std::remove_cvref_t<decltype(elements[0])>;
          using B = std::remove_cvref_t<decltype(others[0])>;
          if constexpr (std::is_same_v<A, B>) {
            for (auto& element : elements) move(element, others[at++]);
          }
        });
      });
    }
  }

  std::shared_ptr<const UnitDescription> description_;
  std::map<ValueReference, ValueBlock> values_;
  std::optional<std::map<ValueReference, ValueBlock>> saved_values_;
  std::span<const BoundValues> outputs_;  ///< of the step that has begun
  bool initializing_ = false;
  bool in_event_mode_ = false;
};

}  // namespace stride::core

#endif
