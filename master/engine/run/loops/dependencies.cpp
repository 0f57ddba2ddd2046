#include "master/engine/run/loops/dependencies.h"

#include <algorithm>
#include <iterator>

namespace stride::core {
namespace {

/// A value that does not vary with time does not vary with inputs.
bool never_follows_inputs(const Variable& variable) {
  return variable.variability == Variability::Constant ||
         variable.variability == Variability::Fixed || variable.variability == Variability::Tunable;
}

bool is_constant(const Variable& variable) { return variable.variability == Variability::Constant; }

}  // namespace

bool carries_value(const System& system, const Connection& connection, Phase phase) {
  const bool is_initial = system.variable(connection.to).variability == Variability::Fixed;
  if (is_initial && phase == Phase::Events) return false;
  const auto has_value = [&](VariableId id) {
    return phase == Phase::Initialization ? system.is_signal(id)
                                          : system.variable(id).is_unclocked_value();
  };
  return has_value(connection.from) && has_value(connection.to);
}

Dependencies::Dependencies(const System& system, Phase phase)
    : system_(system), phase_(phase), inputs_(system.components().size()) {
  for (const Connection& connection : system.connections()) {  // sorted by target
    if (!carries_value(system, connection, phase)) continue;
    std::vector<std::size_t>& inputs = inputs_[connection.to.component];
    const bool is_next_element = !inputs.empty() && inputs.back() == connection.to.variable;
    if (!is_next_element) inputs.push_back(connection.to.variable);
  }
  for (const Component& component : system.components()) {
    const auto [entry, is_new] = declared_.try_emplace(component.description.get());
    if (!is_new) continue;
    Declared& declared = entry->second;
    const UnitDescription& unit = *component.description;
    for (std::size_t i = 0; i < unit.variables.size(); ++i) {
      declared.variables.emplace(unit.variables[i].reference, i);
    }
    for (const Unknown& output : unit.outputs) declared.outputs[output.reference] = &output;
    for (const Unknown& initial : unit.initial_unknowns) {
      declared.initial_unknowns[initial.reference] = &initial;
    }
  }
}

bool Dependencies::depends_on_nothing(const UnitDescription& unit, const Variable& output) const {
  if (never_follows_inputs(output)) return phase_ == Phase::Events || is_constant(output);
  return phase_ == Phase::Initialization ? output.initial == Initial::Exact : !unit.has_event_mode;
}

/// A calculated parameter is calculated from parameters.
std::vector<std::size_t> Dependencies::parameters_among(const UnitDescription& unit,
                                                        const std::vector<std::size_t>& variables) {
  std::vector<std::size_t> parameters;
  std::ranges::copy_if(variables, std::back_inserter(parameters), [&](std::size_t variable) {
    return unit.variables[variable].causality == Causality::Parameter;
  });
  return parameters;
}

const Unknown* Dependencies::unknown(const Declared& declared, const Variable& output) const {
  const auto find = [&](const std::map<ValueReference, const Unknown*>& unknowns) {
    const auto found = unknowns.find(output.reference);
    return found == unknowns.end() ? nullptr : found->second;
  };
  const Unknown* initial =
      phase_ == Phase::Initialization ? find(declared.initial_unknowns) : nullptr;
  return initial != nullptr ? initial : find(declared.outputs);
}

Dependencies::Inputs Dependencies::inputs_of(VariableId output) const {
  const UnitDescription& unit = *system_.components()[output.component].description;
  const Variable& variable = unit.variables[output.variable];
  if (depends_on_nothing(unit, variable)) return {};
  const Declared& declared = declared_.at(&unit);
  const std::vector<std::size_t>& connected = inputs_[output.component];
  const Unknown* found = unknown(declared, variable);
  if (never_follows_inputs(variable)) return {true, parameters_among(unit, connected)};
  if (found == nullptr || !found->dependencies) return {false, {}};
  Inputs inputs;
  for (const ValueReference reference : *found->dependencies) {
    const auto known = declared.variables.find(reference);
    if (known == declared.variables.end()) continue;
    if (!std::binary_search(connected.begin(), connected.end(), known->second)) continue;
    inputs.variables.push_back(known->second);
  }
  std::sort(inputs.variables.begin(), inputs.variables.end());
  inputs.variables.erase(std::unique(inputs.variables.begin(), inputs.variables.end()),
                         inputs.variables.end());
  return inputs;
}

}  // namespace stride::core
