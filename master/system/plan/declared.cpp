#include "master/system/plan/declared.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/engine/model/system/known_names.h"
#include "master/system/plan/load_units.h"
#include "master/system/plan/split_option.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {
namespace {

void swap(const std::string& text, Scenario& scenario) {
  auto& components = scenario.system.components;
  const std::vector<std::string> names = component_names(scenario.system);
  const auto [name, file] =
      component_file("--swap", text, "component=FILE.fmu", core::KnownNames(names));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    core::fail_input({}, fmt::format("--swap {}: there is no component '{}'", text, name),
                     core::suggestion(name, names));
  }
  const auto i = static_cast<std::size_t>(found - names.begin());
  scenario.sources[i] = file;
  components[i].where = {fmt::format("--swap {}", text), 0};
}

ssp::ParameterValue set_value(const std::string& text, const core::KnownNames& names) {
  const auto [name, value] = split_option("--set", text, "component.variable=value", names);
  ssp::ParameterValue made;
  made.name = name;
  made.value = value;
  made.where = {fmt::format("--set {}", text), 0};
  made.is_required = true;
  return made;
}

/// Whether a name holds a '=', or a value does.
bool is_unclear(const std::string& text) { return std::ranges::count(text, '=') > 1; }

/// The units may be loaded for it, since they know the names of their variables.
core::KnownNames names_of_start_values(const ScenarioRequest& request, Scenario scenario) {
  core::KnownNames names;
  for (const core::InputDeclaration& input : scenario.system.inputs) {
    names.add(input.via.front().connector.name, true);
  }
  for (const core::OutputDeclaration& output : scenario.system.outputs) {
    names.add(output.via.back().connector.name, true);
  }
  for (const std::string& text : request.swaps) swap(text, scenario);
  UnitStore own;
  const auto fmus = load_fmus(scenario, request.units ? *request.units : own,
                              hosts_for_loading(scenario, request.hosts));
  for (std::size_t i = 0; i < fmus.size(); ++i) {
    names.add(scenario.system.components[i].name + ".", *fmus[i]->description());
  }
  return names;
}

/// The parameters, and the values of --set, which have precedence.
std::vector<ssp::ParameterValue> set_values(const ScenarioRequest& request,
                                            const core::KnownNames& names) {
  std::vector<ssp::ParameterValue> values = request.parameters;
  for (const std::string& text : request.sets) values.push_back(set_value(text, names));
  return values;
}

ReadOptions read_options(const ScenarioRequest& request) {
  ReadOptions options{find_unit, {}, request.files, nullptr};
  if (std::ranges::any_of(request.sets, is_unclear)) {
    options.late_parameters = [&](const Scenario& scenario) {
      return set_values(request, names_of_start_values(request, scenario));
    };
  } else {
    options.parameters = set_values(request, {});
  }
  return options;
}

}  // namespace

Scenario declare(const ScenarioRequest& request) {
  Scenario scenario = read_scenario(request.scenario, read_options(request));
  for (const std::string& text : request.swaps) swap(text, scenario);
  if (scenario.system.components.empty()) {
    core::fail_input({.where = {scenario.path.string(), 0}},
                     "the system has no component, so there is nothing to simulate");
  }
  return scenario;
}

ScenarioChanges changes_of(const ScenarioRequest& request) {
  ScenarioChanges changes{
      .swaps = request.swaps, .values = {}, .parameter_files = request.parameter_files};
  for (const ssp::ParameterValue& parameter : request.parameters) {
    changes.values.push_back(parameter.name + "=" + parameter.value);
  }
  changes.values.insert(changes.values.end(), request.sets.begin(), request.sets.end());
  return changes;
}

std::vector<std::string> component_names(const core::SystemDeclaration& system) {
  std::vector<std::string> names;
  for (const core::ComponentDeclaration& component : system.components) {
    names.push_back(component.name);
  }
  return names;
}

}  // namespace stride::scenario
