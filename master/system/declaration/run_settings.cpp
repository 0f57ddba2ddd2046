#include "master/system/declaration/run_settings.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/text/number_text.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"
#include "master/system/declaration/find_variable.h"

namespace stride::scenario {
namespace {

template <class Choices>
typename Choices::value_type parse_word(std::string_view text, const Choices& choices) {
  std::vector<std::string> words;
  for (const auto choice : choices) {
    words.emplace_back(name(choice));
    if (text == words.back()) return choice;
  }
  throw std::invalid_argument(
      fmt::format("unknown value '{}'; {}", text, core::suggestion(std::string(text), words)));
}

[[noreturn]] void fail_below_resolution(const char* what) {
  throw std::invalid_argument(
      fmt::format("{} must be above 0 s, at least the picosecond that times are counted in", what));
}

Duration parse_above_zero(std::string_view text, const char* what) {
  const Duration duration = core::parse_seconds(text);
  if (duration <= Duration::zero()) fail_below_resolution(what);
  return duration;
}

core::Interval parse_size(std::string_view text) {
  const auto size = core::Interval::parse(text);
  if (size.is_below_picosecond()) fail_below_resolution("a step");
  return size;
}

/// Replaces what is set already, if the other value is set.
template <class T, class U>
void take(T& mine, const std::optional<U>& other) {
  if (other) mine = *other;
}

/// ", in line 7"
std::string shown_line(const core::Location& where) {
  return where.line == 0 ? "" : fmt::format(", in line {}", where.line);
}

constexpr std::uint64_t kMebibyte = 1024 * 1024;

void check(const IdleRule& rule, const core::StepOptions& step) {
  if (!rule.max_skip || !step.policy->has_grid || core::Interval(*rule.max_skip) >= step.size) {
    return;
  }
  core::fail_input({rule.where, {}, {}, {}},
                   fmt::format("the longest skip of {} s is below the communication step of {} s, "
                               "so nothing could be skipped",
                               core::to_text(*rule.max_skip), core::to_text(step.size)),
                   "choose a longer one, or switch idle skipping off (enabled=\"false\", "
                   "--no-idle-skip)");
}

/// By component.
std::vector<std::optional<Duration>> max_skips(const std::vector<IdleRule>& rules,
                                               const core::System& system,
                                               const core::StepOptions& step) {
  constexpr Duration kDefault = IdleSettings::kDefaultMaxSkip;
  std::vector<std::string> names;
  for (const core::Component& component : system.components()) names.push_back(component.name);
  std::vector<std::optional<Duration>> skips(names.size(), kDefault);
  const ComponentSelector selector(names);
  for (const IdleRule& rule : rules) {
    check(rule, step);
    for (const std::size_t i : selector.select(rule.components)) {
      skips[i].reset();
      if (rule.enabled) skips[i] = rule.max_skip.value_or(kDefault);
    }
  }
  return skips;
}

}  // namespace

void StepSettings::set_policy(std::string_view text) {
  policy = parse_word(text, core::kStepPolicies);
}
void StepSettings::set_size(std::string_view text) { size = parse_size(text); }
void StepSettings::set_maximum(std::string_view text) { maximum = parse_size(text); }
void StepSettings::set_minimum(std::string_view text) { minimum = parse_size(text); }
void StepSettings::set_relative_tolerance(std::string_view text) {
  relative_tolerance = core::parse_at_least_zero(text);
}
void StepSettings::set_absolute_tolerance(std::string_view text) {
  absolute_tolerance = core::parse_at_least_zero(text);
}
void StepSettings::set_coupling(std::string_view text) {
  coupling = parse_word(text, core::kCouplings);
}
void StepSettings::set_extrapolation(std::string_view text) {
  extrapolation = parse_word(text, core::kExtrapolations);
}

void StepSettings::set_step(std::string_view text) {
  const std::size_t at = text.rfind('=');
  if (at == text.npos) {
    if (size) throw std::invalid_argument("a second step for all components; expected one");
    return set_size(text);
  }
  if (at == 0) throw std::invalid_argument("expected COMPONENT=SECONDS");
  const core::Location where{fmt::format("--step {}", text), 0};
  of_components.push_back(
      {{std::string(text.substr(0, at)), where}, parse_size(text.substr(at + 1))});
}

ComponentSteps StepSettings::component_steps(std::span<const std::string> names) const {
  std::vector<const ComponentStep*> found(names.size());
  ComponentSteps steps(names.size());
  const ComponentSelector selector(names);
  for (const ComponentStep& step : of_components) {
    for (const std::size_t i : selector.select(step.components)) {
      if (const ComponentStep* const first = std::exchange(found[i], &step)) {
        core::fail_input({step.components.where, names[i], {}, {}},
                         fmt::format("a second step for this component, {} s; the first is {} s{}",
                                     core::to_text(step.size), core::to_text(first->size),
                                     shown_line(first->components.where)),
                         "give it one of them");
      }
      steps[i] = step.size;
    }
  }
  return steps;
}

void StepSettings::apply(core::RunOptions& options) const {
  take(options.step.policy, policy);
  take(options.step.size, size);
  take(options.step.maximum, maximum);
  take(options.step.minimum, minimum);
  take(options.step.relative_tolerance, relative_tolerance);
  take(options.step.absolute_tolerance, absolute_tolerance);
  take(options.coupling, coupling);
  take(options.extrapolation, extrapolation);
}

void HostSettings::override_with(const HostSettings& other) {
  if (other.process) where = other.where;
  take(process, other.process);
  take(call_limit, other.call_limit);
  take(memory_limit, other.memory_limit);
  take(sandbox, other.sandbox);
  take(snapshots, other.snapshots);
  if (other.process == false) remote.reset();
  if (other.remote) remote = other.remote;
}

std::vector<HostSettings> HostRules::settings(std::span<const std::string> components) const {
  std::vector<HostSettings> settings(components.size());
  const ComponentSelector selector(components);
  for (const HostRule& rule : rules) {
    for (const std::size_t i : selector.select(rule.components)) {
      settings[i].override_with(rule.settings);
    }
  }
  return settings;
}

std::chrono::milliseconds parse_call_limit(std::string_view text) {
  return std::chrono::ceil<std::chrono::milliseconds>(parse_above_zero(text, "a time limit"));
}

std::uint64_t parse_memory_limit(std::string_view text) {
  const auto number = xml::to_number<std::uint64_t>(text);
  const bool fits =
      number && *number > 0 && *number <= std::numeric_limits<std::uint64_t>::max() / kMebibyte;
  if (!fits) {
    throw std::invalid_argument(
        fmt::format("'{}' is not a whole number of MiB; expected at least 1", text));
  }
  return *number * kMebibyte;
}

core::IdleOptions IdleSettings::options(const core::System& system,
                                        const core::StepOptions& step) const {
  core::IdleOptions options;
  options.least = step.policy->has_grid ? step.size.rounded() : Duration{1};
  options.max_skip = max_skips(rules, system, step);
  const auto is_input = [](const core::UnitDescription& unit, const core::Variable& variable) {
    return unit.promises_idle && variable.causality == core::Causality::Input &&
           variable.type == core::ValueType::Float64;
  };
  for (const IdleNumber& deadband : deadbands) {
    options.deadbands.push_back(
        {find_variable(system, deadband.variable, deadband.where,
                       "a Float64 input of a unit that can promise to be idle", is_input),
         deadband.value});
  }
  const auto has_one = [](const core::UnitDescription&, const core::Variable& variable) {
    return variable.tolerance.has_value();
  };
  for (const IdleNumber& tolerance : tolerances) {
    options.tolerances.push_back({find_variable(system, tolerance.variable, tolerance.where,
                                                "an output with a tolerance", has_one),
                                  tolerance.value});
  }
  return options;
}

Duration parse_max_skip(std::string_view text) { return parse_above_zero(text, "a skip"); }

}  // namespace stride::scenario
