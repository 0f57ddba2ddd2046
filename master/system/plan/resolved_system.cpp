#include "master/system/plan/resolved_system.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/engine/model/unit_of_measure.h"
#include "master/system/declaration/component_selection.h"
#include "master/system/declaration/terminal_connections.h"
#include "master/system/plan/declared.h"
#include "master/system/plan/load_units.h"
#include "master/system/scenario/recordings.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/units/file_units.h"

namespace stride::scenario {
namespace {

void describe_units(ResolvedSystem& resolved, const ScenarioRequest& request) {
  Scenario& scenario = resolved.scenario;
  UnitStore own;
  resolved.fmus = load_fmus(scenario, request.units ? *request.units : own,
                            hosts_for_loading(scenario, request.hosts));
  std::set<std::string> known;
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    const auto& description = resolved.fmus[i]->description();
    scenario.system.components[i].description = description;
    scenario.system.components[i].is_table = is_table(scenario.sources[i]);
    for (const std::string& warning : description->warnings) {
      if (known.insert(warning).second) scenario.warnings.push_back(warning);
    }
  }
}

std::string unit_hint(const Scenario& scenario, const core::UnitsOfMeasure& defined,
                      const std::string& unit) {
  std::vector<std::string> names = core::known_unit_names();
  for (const auto& [name, meaning] : defined) names.push_back(name);
  const std::string near = core::nearest(unit, names);
  const std::string meant = near.empty() ? "" : fmt::format("did you mean '{}'? Or ", near);
  return meant + fmt::format(
                     "define it in the <ssd:Units> of {}: <ssc:Unit name=\"{}\"><ssc:BaseUnit "
                     "m=\"1\" factor=\"…\"/></ssc:Unit>, with the powers of its base units",
                     scenario.alone.empty() ? scenario.files->shown(scenario.path)
                                            : "a system (.ssd) with the table as a component",
                     unit);
}

/// An FMU defines its units of measure itself, a table cannot.
void warn_of_unknown_units(ResolvedSystem& resolved) {
  Scenario& scenario = resolved.scenario;
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    const core::ComponentDeclaration& component = scenario.system.components[i];
    if (!component.is_table) continue;
    const core::UnitsOfMeasure none;
    const auto& defined = component.units_of_measure ? *component.units_of_measure : none;
    for (const core::Variable& column : component.description->variables) {
      const core::UnitOfMeasure unit{column.unit, core::find_defined(defined, column.unit)};
      if (core::undefined_text(unit).empty()) continue;
      scenario.warnings.push_back(fmt::format(
          "{}: column '{}': nothing defines '{}', its unit of measure, and it is not known by "
          "name, so its values are converted into no other\n  hint: {}",
          scenario.files->shown(scenario.sources[i]), column.name, column.unit,
          unit_hint(scenario, defined, column.unit)));
    }
  }
}

/// Those that `stride complete` has written are there already.
void add_terminal_connections(ResolvedSystem& resolved) {
  auto& connections = resolved.scenario.system.connections;
  for (auto& made :
       scenario::connect_terminals(resolved.scenario.annotation.terminals,
                                   resolved.scenario.system.components, resolved.fmus)) {
    const bool is_there = std::ranges::any_of(connections, [&](const auto& other) {
      return other.from_component == made.from_component &&
             other.from_connector == made.from_connector &&
             other.to_component == made.to_component && other.to_connector == made.to_connector;
    });
    if (!is_there) connections.push_back(std::move(made));
  }
}

void add_twins(ResolvedSystem& resolved) {
  Scenario& scenario = resolved.scenario;
  resolved.idle_twins = add_idle_twins(scenario.system);
  for (const IdleTwin& pair : resolved.idle_twins) {
    scenario.sources.push_back(scenario.sources[pair.unit]);
    resolved.fmus.push_back(resolved.fmus[pair.unit]);
  }
}

void allow_early_returns(ResolvedSystem& resolved) {
  const auto allowed = permissions(resolved, resolved.scenario.annotation.early_return);
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    resolved.scenario.system.components[i].early_return_allowed = allowed[i];
  }
}

/// A component whose own functions for its state are not to be used counts as one without them.
void allow_state_saving(ResolvedSystem& resolved) {
  const auto allowed = permissions(resolved, resolved.scenario.annotation.state_saving);
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (allowed[i]) continue;
    auto& description = resolved.scenario.system.components[i].description;
    auto without = std::make_shared<core::UnitDescription>(*description);
    without->can_save_state = without->can_serialize_state = false;
    description = std::move(without);
  }
}

}  // namespace

std::vector<std::string> ResolvedSystem::selection_names() const {
  std::vector<std::string> names = component_names(scenario.system);
  for (const IdleTwin& pair : idle_twins) names[pair.twin] = names[pair.unit];
  return names;
}

ResolvedSystem resolve(Scenario declared, const ScenarioRequest& request) {
  ResolvedSystem resolved{std::move(declared)};
  describe_units(resolved, request);
  switch_on(kFilm, resolved.scenario.system, request.film);
  switch_on(kScene, resolved.scenario.system, request.scene);
  warn_of_unknown_units(resolved);
  add_terminal_connections(resolved);
  if (request.idle_twins) add_twins(resolved);
  allow_early_returns(resolved);
  allow_state_saving(resolved);
  return resolved;
}

std::vector<bool> permissions(const ResolvedSystem& system, std::span<const PermissionRule> rules) {
  const std::vector<std::string> names = system.selection_names();
  const ComponentSelector selector(names);
  std::vector<bool> allowed(names.size(), true);
  for (const PermissionRule& rule : rules) {
    for (const std::size_t i : selector.select(rule.components)) allowed[i] = rule.allowed;
  }
  return allowed;
}

}  // namespace stride::scenario
