#include "master/study/verify/idle_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/study/verify/finding.h"

namespace stride::verify {
namespace {

using core::ValueBlock;
using core::Variable;

/// What the rounding of a tangent may add to a tolerance, as a share of the value.
constexpr double kTangentRounding = 1e-12;

bool is_within(const ValueBlock& one, const ValueBlock& other, double distance) {
  for (std::size_t e = 0; e < one.size(); ++e) {
    const double a = core::real(one, e);
    const double b = core::real(other, e);
    if (!(std::abs(a - b) <= distance + kTangentRounding * std::abs(a)) && a != b) return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> promised_outputs(const core::UnitDescription& unit) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < unit.variables.size(); ++i) {
    const Variable& variable = unit.variables[i];
    if (variable.causality == core::Causality::Output && variable.is_unclocked_value()) {
      places.push_back(i);
    }
  }
  return places;
}

IdleRun::IdleRun(const TestedUnit& tested, TestInstance& instance, const Stimulus& stimulus,
                 bool is_skipping)
    : tested_(tested),
      instance_(instance),
      stimulus_(stimulus),
      outputs_(promised_outputs(tested.description())) {
  if (is_skipping) promises_ = &instance.capability<core::IdlePromises>();
}

Recording IdleRun::run() {
  if (promises_ != nullptr) promises_->enable_idle_skipping(Duration::max());
  instance_.start();
  for (std::size_t k = 0; k < tested_.steps(); ++k) {
    const bool ends = suspension_ && (is_disturbed(k) || suspension_->until < tested_.point(k + 1));
    if (ends) catch_up(k);
    if (instance_.recording().has_ended) break;
    if (!suspension_) {
      instance_.hand_over_inputs();
      suspend_if_idle(k);
    }
    if (suspension_ && suspension_->until == tested_.point(k + 1)) {
      catch_up(k + 1);
      record(k + 1, read_outputs());
    } else if (suspension_) {
      record(k + 1, predicted(tested_.point(k + 1)));
    } else {
      instance_.step_to_next_point();
      if (instance_.recording().has_ended) break;
      record(k + 1, read_outputs());
    }
  }
  if (suspension_) catch_up(tested_.steps());
  Recording recording = instance_.recording();
  recording.longest_promise = longest_promise_;
  recording.longest_suspension = longest_suspension_;
  for (Row& row : rows_) recording.rows.push_back(std::move(row));
  return recording;
}

bool IdleRun::is_disturbed(std::size_t k) const {
  if (stimulus_.ticks_at(k) || stimulus_.changes_at(k)) return true;
  const auto& inputs = stimulus_.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].is_clocked) continue;
    const Variable& variable = tested_.description().variables[inputs[i].variable];
    const ValueBlock now = stimulus_.value(inputs[i], k);
    const ValueBlock& held = suspension_->held[i];
    const bool is_real = core::is_real(variable.type);
    const bool stays = is_real ? is_within(held, now, variable.deadband) : held == now;
    if (!stays) return true;
  }
  return false;
}

void IdleRun::suspend_if_idle(std::size_t k) {
  if (promises_ == nullptr || instance_.recording().has_ended) return;
  const Time now = instance_.now();
  Time until = promises_->idle_until();
  if (const auto& event = instance_.position().next_event) until = std::min(until, *event);
  if (const auto tick = instance_.clocks().next()) until = std::min(until, *tick);
  if (until < tested_.point(k + 1)) return;
  Suspension& made = suspension_.emplace(Suspension{now, until, {}, read_outputs(), slopes()});
  for (const Stimulus::Input& input : stimulus_.inputs()) {
    made.held.push_back(stimulus_.value(input, k));
  }
  ++used_promises_;
  longest_promise_ =
      std::max(longest_promise_, until == Time::max() ? Duration::max() : until - now);
}

std::vector<double> IdleRun::slopes() {
  std::vector<core::ValueReference> references;
  std::size_t elements = 0;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (!output(i).tolerance) continue;
    references.push_back(output(i).reference);
    elements += output(i).size;
  }
  std::vector<double> slopes(elements);
  if (!references.empty()) promises_->get_derivatives(references, slopes);
  return slopes;
}

std::vector<ValueBlock> IdleRun::predicted(Time time) const {
  std::vector<ValueBlock> values = suspension_->outputs;
  const double elapsed = to_seconds(time - suspension_->since);
  std::size_t slope = 0;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (!output(i).tolerance) continue;
    for (std::size_t e = 0; e < values[i].size(); ++e) {
      const double value = core::real(values[i], e);
      core::set_real(values[i], e, value + suspension_->slopes[slope++] * elapsed);
    }
  }
  return values;
}

/// To the point k, which is not behind the end of the promise.
void IdleRun::catch_up(std::size_t k) {
  const Time time = tested_.point(k);
  if (time > suspension_->since) {
    const std::vector<ValueBlock> expected = predicted(time);
    const Recording before = instance_.recording();
    check_step(instance_.leap_to(k), before);
    if (time < suspension_->until) check_outputs(expected);
    longest_suspension_ = std::max(longest_suspension_, time - suspension_->since);
  }
  suspension_.reset();
}

void IdleRun::check_step(bool was_made, const Recording& before) const {
  const Recording& after = instance_.recording();
  if (!was_made) fail("rejects the step to there");
  if (after.early_returns != before.early_returns) {
    fail(fmt::format("returns early at {} s", core::to_text(instance_.now())));
  }
  const bool is_early = instance_.now() < suspension_->until;
  if (is_early && after.events != before.events) {
    fail(fmt::format("has an event at {} s", core::to_text(instance_.now())));
  }
}

void IdleRun::check_outputs(const std::vector<ValueBlock>& expected) {
  const std::vector<ValueBlock> seen = read_outputs();
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const std::optional<double>& tolerance = output(i).tolerance;
    const bool holds = tolerance ? is_within(expected[i], seen[i], *tolerance)
                                 : core::elements_text(expected[i]) == core::elements_text(seen[i]);
    if (holds) continue;
    fail(fmt::format("'{}' is {} at {} s instead of {}{}", output(i).name,
                     core::elements_text(seen[i]), core::to_text(instance_.now()),
                     core::elements_text(expected[i]),
                     tolerance ? fmt::format(" within {}", *tolerance) : ""));
  }
}

std::vector<ValueBlock> IdleRun::read_outputs() {
  std::vector<ValueBlock> values;
  values.reserve(outputs_.size());
  for (std::size_t i = 0; i < outputs_.size(); ++i) values.push_back(instance_.get(output(i)));
  return values;
}

void IdleRun::record(std::size_t k, const std::vector<ValueBlock>& outputs) {
  Row row{tested_.point(k), {}, false};
  for (const ValueBlock& value : outputs) row.values.push_back(core::elements_text(value));
  row.values.push_back(std::to_string(used_promises_));
  rows_.push_back(std::move(row));
}

void IdleRun::fail(const std::string& violation) const {
  const Time until = suspension_->until;
  throw Failure(fmt::format("it promised at {} s to be idle until {}, but {}",
                            core::to_text(suspension_->since),
                            until == Time::max() ? "an input changes" : core::to_text(until) + " s",
                            violation),
                false);
}

}  // namespace stride::verify
