#include "master/system/plan/declared.h"

#include <algorithm>
#include <map>

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

/// Returns the component.
std::string swap(const std::string& text, Scenario& scenario) {
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
  return name;
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
    const std::string& component = scenario.system.components[i].name;
    names.add(component + ".", *fmus[i]->description());
    if (component == scenario.alone) names.stand_alone(component, *fmus[i]->description());
  }
  return names;
}

using Values = std::vector<ssp::ParameterValue>;

Values set_values(const ScenarioRequest& request, const core::KnownNames& names) {
  Values values;
  for (const std::string& text : request.sets) values.push_back(set_value(text, names));
  return values;
}

/// The parameters, and the values of --set, which have precedence.
Values with_parameters(const ScenarioRequest& request, const Values& sets) {
  Values values = request.parameters;
  values.insert(values.end(), sets.begin(), sets.end());
  return values;
}

/// `sets` becomes the values of --set, at the latest when the scenario is read.
ReadOptions read_options(const ScenarioRequest& request, Values& sets) {
  ReadOptions options{find_unit, {}, request.files, nullptr};
  if (std::ranges::any_of(request.sets, is_unclear)) {
    options.late_parameters = [&](const Scenario& scenario) {
      sets = set_values(request, names_of_start_values(request, scenario));
      return with_parameters(request, sets);
    };
  } else {
    sets = set_values(request, {});
    options.parameters = with_parameters(request, sets);
  }
  return options;
}

/// Of an option of two values for one thing, of which the later one counts.
void note_replaced(const std::string& later, const std::string& earlier, Scenario& scenario) {
  if (later == earlier) return;
  scenario.warnings.push_back(fmt::format("{} replaces {}; leave one of them out", later, earlier));
}

void note_replaced_values(const Values& sets, Scenario& scenario) {
  std::map<std::string, std::string> latest;  // by name
  for (const ssp::ParameterValue& value : sets) {
    std::string& earlier = latest[core::with_component(scenario.alone, value.name)];
    if (!earlier.empty()) note_replaced(value.where.file, earlier, scenario);
    earlier = value.where.file;
  }
}

void swap_all(const ScenarioRequest& request, Scenario& scenario) {
  std::map<std::string, std::string> latest;  // by component
  for (const std::string& text : request.swaps) {
    std::string& earlier = latest[swap(text, scenario)];
    if (!earlier.empty()) note_replaced("--swap " + text, "--swap " + earlier, scenario);
    earlier = text;
  }
}

}  // namespace

Scenario declare(const ScenarioRequest& request) {
  Values sets;
  Scenario scenario = read_scenario(request.scenario, read_options(request, sets));
  note_replaced_values(sets, scenario);
  swap_all(request, scenario);
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
