#include "master/scenario/idle_choice.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "master/util/suggest.h"
#include "master/util/time_text.h"

namespace stride::io {
namespace {

/// The variable, if `fits` says that it is of the kind. What else is named has no promise to widen.
template <class Fits>
core::VariableId find(const core::System& system, const IdleNumber& number, const char* kind,
                      Fits&& fits) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (!fits(*system.components()[i].description, variables[k])) continue;
      names.push_back(system.full_name({i, k}));
      if (names.back() == number.variable) return {i, k};
    }
  }
  core::fail_input({number.where, {}, {}, {}}, fmt::format("'{}' is no {}", number.variable, kind),
                   core::suggestion(number.variable, names));
}

void check(const IdleRule& rule, const core::StepOptions& step) {
  if (!rule.max_skip || !step.policy->has_grid || *rule.max_skip >= step.size) {
    return;
  }
  core::fail_input({rule.where, {}, {}, {}},
                   fmt::format("the longest skip of {} s is below the communication step of {} s, "
                               "so nothing could be skipped",
                               core::to_text(Time(*rule.max_skip)), core::to_text(Time(step.size))),
                   "choose a longer one, or switch idle skipping off (enabled=\"false\", "
                   "--no-idle-skip)");
}

}  // namespace

core::IdleOptions IdleChoice::options(const core::System& system,
                                      const core::StepOptions& step) const {
  core::IdleOptions options;
  options.least = step.policy->has_grid ? step.size : Duration{1};
  std::vector<std::string> names;
  for (const core::Component& component : system.components()) names.push_back(component.name);
  options.max_skip.assign(names.size(), kDefaultMaxSkip);
  for (const IdleRule& rule : rules) {
    check(rule, step);
    for (const std::size_t i : select_components(names, {&rule.components, 1})) {
      options.max_skip[i].reset();
      if (rule.enabled) options.max_skip[i] = rule.max_skip.value_or(kDefaultMaxSkip);
    }
  }
  for (const IdleNumber& deadband : deadbands) {
    const auto is_input = [](const core::UnitDescription& unit, const core::Variable& variable) {
      return unit.promises_idle && variable.causality == core::Causality::Input &&
             variable.type == core::ValueType::Float64;
    };
    options.deadbands.push_back(
        {find(system, deadband, "Float64 input of a unit that can promise to be idle", is_input),
         deadband.value});
  }
  for (const IdleNumber& tolerance : tolerances) {
    const auto has_one = [](const core::UnitDescription&, const core::Variable& variable) {
      return variable.tolerance.has_value();
    };
    options.tolerances.push_back(
        {find(system, tolerance, "output with a tolerance", has_one), tolerance.value});
  }
  return options;
}

Duration parse_max_skip(std::string_view text) {
  const Duration skip = parse_seconds(text);
  if (skip <= Duration::zero()) throw std::invalid_argument("a skip must be above 0 s");
  return skip;
}

}  // namespace stride::io
