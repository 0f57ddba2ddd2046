#include "master/system/scenario/component_steps.h"

#include <algorithm>
#include <utility>

namespace stride::scenario {
namespace {

/// Whether all components make the same steps, as they do without any of their own.
bool make_same_steps(std::span<const core::ComponentDeclaration> components,
                     const ComponentSteps& steps, const core::RunOptions& options) {
  const core::Interval& size = options.step.size;
  const bool are_equal =
      std::ranges::all_of(steps, [&](const auto& step) { return step.value_or(size) == size; });
  const bool is_regular = options.step.policy->has_grid && !options.step.maximum;
  if (!are_equal || !is_regular) return false;
  // the order of the units would be another one
  if (options.coupling == core::Coupling::GaussSeidel) return true;
  return std::ranges::none_of(components,
                              [](const auto& c) { return c.description->can_vary_step; });
}

}  // namespace

std::optional<core::Interval> declared_step(const core::UnitDescription& unit) {
  return unit.default_step ? unit.default_step : unit.fixed_internal_step;
}

ComponentSteps choose_component_steps(std::span<const core::ComponentDeclaration> components,
                                      ComponentSteps set, const core::RunOptions& options,
                                      bool is_size_set) {
  const core::Interval& size = options.step.size;
  ComponentSteps steps = std::move(set);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const core::UnitDescription& unit = *components[i].description;
    if (steps[i] || unit.can_vary_step) continue;
    const bool has_run_step = options.step.policy->has_grid || is_size_set;
    steps[i] = is_size_set ? size : declared_step(unit);
    if (!steps[i] && has_run_step) steps[i] = size;
  }
  if (make_same_steps(components, steps, options)) return ComponentSteps(steps.size());
  const bool are_multiples = std::ranges::all_of(
      steps, [&](const auto& step) { return step.value_or(size).is_multiple_of(size); });
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is_of_run = options.step.policy->has_grid && !are_multiples;
    if (is_of_run && !steps[i] && !components[i].may_return_early()) steps[i] = size;
  }
  return steps;
}

}  // namespace stride::scenario
