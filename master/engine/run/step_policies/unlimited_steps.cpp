#include "master/engine/run/step_policies/unlimited_steps.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/engine/run/step_policies/step_limits.h"

namespace stride::core {
namespace {

bool changes_without_event(const System& system, VariableId id) {
  const Variable& output = system.variable(id);
  if (!output.is_unclocked_value()) return false;
  const bool has_event_mode = system.components()[id.component].description->has_event_mode;
  return output.variability == Variability::Continuous ||
         (output.variability == Variability::Discrete && !has_event_mode);
}

}  // namespace

bool has_unlimited_steps(const System& system, const RunOptions& options) {
  if (options.step.policy->controls_error || StepLimits(system, options).maximum()) return false;
  const auto has_own_step = [](const Component& component) {
    return component.own_step.has_value();
  };
  if (std::ranges::any_of(system.components(), has_own_step)) return false;
  const Duration run = options.stop - options.start;
  return run > Duration{} && (!options.step.policy->has_grid || options.step.size >= Interval(run));
}

std::vector<std::string> connections_without_events(const System& system) {
  std::vector<std::string> names;
  for (const Connection& connection : system.connections()) {
    if (!changes_without_event(system, connection.from)) continue;
    names.push_back(fmt::format("{} → {}", system.range_name(connection.source()),
                                system.range_name(connection.target())));
  }
  return names;
}

}  // namespace stride::core
