#include "tests/property/promise.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/engine/model/values.h"

namespace stride::tests {
namespace {

using core::Causality;
using core::ValueBlock;
using core::ValueType;
using core::Variable;

/// The rounding of doubles, beside a tolerance.
constexpr double kRounding = 1e-12;

bool is_held_output(const Variable& variable) {
  return variable.causality == Causality::Output && variable.type != ValueType::Clock &&
         !variable.is_clocked();
}

/// What was promised of one output.
struct PromisedOutput {
  const Variable* variable;
  ValueBlock value;
  std::vector<double> slopes;

  /// Empty if the output keeps to it.
  std::string violation(SteppedUnit& stepped, Duration elapsed) const {
    const ValueBlock present = stepped.get(*variable);
    if (!variable->tolerance) {
      if (present == value) return {};
      return fmt::format("'{}' was to stay {} and is {}", variable->name,
                         core::element_text(value, 0), core::element_text(present, 0));
    }
    for (std::size_t i = 0; i < present.size(); ++i) {
      const double expected = real(value, i) + slopes[i] * to_seconds(elapsed);
      const double error = std::abs(real(present, i) - expected);
      if (error <= *variable->tolerance + kRounding * std::abs(expected)) continue;
      return fmt::format("'{}' is {} from its tangent, more than {}", variable->name, error,
                         *variable->tolerance);
    }
    return {};
  }
};

std::vector<PromisedOutput> promised_outputs(SteppedUnit& stepped) {
  std::vector<PromisedOutput> promised_outputs;
  for (const Variable& variable : stepped.description().variables) {
    if (!is_held_output(variable)) continue;
    promised_outputs.push_back(
        {&variable, stepped.get(variable),
         variable.tolerance ? stepped.slopes(variable) : std::vector<double>{}});
  }
  return promised_outputs;
}

/// One step on the way to `until`, and what it breaks.
std::string checked_step(SteppedUnit& stepped, Time begin, Time to, Time until,
                         const std::vector<PromisedOutput>& promised) {
  const core::StepResult result = stepped.step(to);
  const auto broken = [&](const std::string& what) {
    return fmt::format("promised at {} s until {} s, but at {} s {}", to_seconds(begin),
                       to_seconds(until), to_seconds(stepped.now()), what);
  };
  if (result.rejected) return broken("it rejects a step");
  if (result.early_return) return broken("it returns early");
  if (result.event_handling_needed && stepped.now() < until) return broken("it wants an event");
  if (stepped.now() >= until) return {};  // at `until` itself something may happen
  for (const PromisedOutput& output : promised) {
    const std::string violation = output.violation(stepped, stepped.now() - begin);
    if (!violation.empty()) return broken(violation);
  }
  return {};
}

class InputVariation {
 public:
  explicit InputVariation(SteppedUnit& stepped) : stepped_(stepped) {
    for (const Variable& variable : stepped.description().variables) {
      if (variable.deadband == 0 || variable.causality != Causality::Input) continue;
      inputs_.push_back({&variable, real(stepped.get(variable), 0)});
    }
  }
  void set(std::mt19937_64& random) {
    for (const auto& [variable, value] : inputs_) {
      const double way = std::uniform_real_distribution(-1.0, 1.0)(random);
      stepped_.set(*variable, value + way * variable->deadband);
    }
  }

 private:
  SteppedUnit& stepped_;
  std::vector<std::pair<const Variable*, double>> inputs_;
};

/// Small steps, of random sizes up to a tenth of the time.
std::string check_in_steps(SteppedUnit& stepped, Time begin, Time until,
                           const std::vector<PromisedOutput>& promised, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  InputVariation variation(stepped);
  constexpr int kSteps = 60;
  const double shortest = std::log(to_seconds(until - begin) * 1e-4);
  const double longest = std::log(to_seconds(until - begin) * 0.1);
  for (int i = 0; i < kSteps && stepped.now() < until; ++i) {
    variation.set(random);
    const double size = std::exp(std::uniform_real_distribution(shortest, longest)(random));
    const Duration step = std::max(Duration(1), duration_from_seconds(size));
    const Time to = i + 1 == kSteps ? until : std::min(until, stepped.now() + step);
    std::string broken = checked_step(stepped, begin, to, until, promised);
    if (!broken.empty()) return broken;
  }
  return {};
}

}  // namespace

SteppedUnit::SteppedUnit(std::shared_ptr<importer::Fmu> fmu, const Settings& settings,
                         std::optional<Duration> max_skip)
    : fmu_(std::move(fmu)), unit_(fmu_->instantiate("unit", {.early_return_allowed = true})) {
  if (max_skip) idle(*unit_).enable_idle_skipping(*max_skip);
  for (const auto& [name, text] : settings) set(name, text);
  unit_->enter_initialization(now_, std::nullopt);
  unit_->exit_initialization();
  if (description().has_event_mode) handle_events();
}

void SteppedUnit::set(const std::string& name, const std::string& text) {
  const Variable& variable = description().variables.at(description().find(name).value());
  unit_->set(std::span(&variable.reference, 1), core::parse(variable, text));
}

void SteppedUnit::set(const Variable& variable, double value) {
  ValueBlock block(variable.type, variable.size);
  for (std::size_t i = 0; i < block.size(); ++i) core::set_real(block, i, value);
  unit_->set(std::span(&variable.reference, 1), block);
}

core::ValueBlock SteppedUnit::get(const Variable& variable) {
  ValueBlock block(variable.type, variable.size);
  unit_->get(std::span(&variable.reference, 1), block);
  return block;
}

std::vector<double> SteppedUnit::slopes(const Variable& variable) {
  std::vector<double> slopes(variable.size);
  idle(*unit_).get_derivatives(std::span(&variable.reference, 1), slopes);
  return slopes;
}

core::StepResult SteppedUnit::step(Time to) {
  const core::StepResult result = unit_->step({now_, to});
  if (!result.rejected) now_ = result.reached;
  return result;
}

void SteppedUnit::advance(Time to, Duration step) {
  while (now_ < to) {
    Time end = std::min(to, now_ + step);
    if (next_event_ && *next_event_ > now_) end = std::min(end, *next_event_);
    const core::StepResult result = this->step(end);
    REQUIRE_FALSE(result.rejected);
    const bool is_due = next_event_ && *next_event_ <= now_;
    if (!result.event_handling_needed && !is_due) continue;
    handle_event();
  }
}

void SteppedUnit::handle_event() {
  unit_->enter_event_mode();
  handle_events();
}

void SteppedUnit::handle_events() {
  core::EventResult result{
      .discrete_states_need_update = true, .terminate_simulation = false, .next_event_time = {}};
  for (int i = 0; result.discrete_states_need_update; ++i) {
    REQUIRE(i < 100);
    result = unit_->update_discrete_states();
  }
  next_event_ = result.next_event_time;
  unit_->enter_step_mode();
}

Time SteppedUnit::promise() { return std::max(now_, idle(*unit_).idle_until()); }

std::string PromiseCheck::run(Time& promised) {
  promised = single_step.promise();
  const Time begin = single_step.now();
  const Time end = std::min(promised, until);
  if (end <= begin) return {};
  if (small_steps.promise() != promised) return "two equal units promise differently";
  if (no_skipping.promise() != begin) return "it promises though skipping is off";
  const std::vector<PromisedOutput> expected = promised_outputs(single_step);
  for (SteppedUnit* stepped : {&no_skipping, &small_steps}) {
    const std::string broken = check_in_steps(*stepped, begin, end, expected, seed);
    if (!broken.empty()) return broken + (stepped == &no_skipping ? ", with skipping off" : "");
  }
  return checked_step(single_step, begin, end, promised, expected);
}

}  // namespace stride::tests
