#include "master/system/declaration/scenario.h"

#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/base/xml/document.h"
#include "master/engine/model/system/known_names.h"
#include "master/system/declaration/scenario_path.h"
#include "master/system/ssp/flatten.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/system_reader.h"

namespace stride::scenario {
namespace {

template <class T>
std::optional<T> read_seconds(const xml::Element& element, const char* attribute,
                              T (*parse)(std::string_view)) {
  const auto text = element.attribute(attribute);
  if (!text) return std::nullopt;
  try {
    return parse(*text);
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("{}={}", attribute, mistake.what()));
  }
}

std::optional<Time> read_instant(const xml::Element& element, const char* attribute) {
  return read_seconds(element, attribute, &core::parse_time);
}

/// Which the element of this name has in FMI, and not in SSP.
void read_fmi_attributes(const xml::Element& experiment, Scenario& scenario) {
  if (const auto step = read_seconds(experiment, "stepSize", &core::Interval::parse)) {
    if (step->is_below_picosecond()) {
      experiment.fail(fmt::format("stepSize=\"{}\" of {}: expected a number of seconds above 0",
                                  experiment.required("stepSize"), experiment.tag()));
    }
    scenario.vendor_step = {*step, "stepSize of " + experiment.tag(), experiment.where()};
  }
  if (!experiment.attribute("tolerance")) return;
  scenario.warnings.push_back(
      core::to_text({.where = experiment.where()}) +
      fmt::format("the tolerance of {} is ignored: each unit has that of its own",
                  experiment.tag()));
}

void read_default_experiment(const xml::Element& root, Scenario& scenario) {
  const auto experiment = root.child({ssp::kSsd, "DefaultExperiment"});
  if (!experiment) return;
  experiment->allow_attributes({"startTime", "stopTime", "stepSize", "tolerance"});
  experiment->allow_children({{ssp::kSsd, "Annotations"}});
  scenario.start = read_instant(*experiment, "startTime");
  scenario.stop = read_instant(*experiment, "stopTime");
  read_fmi_attributes(*experiment, scenario);
  if (scenario.start && scenario.stop && *scenario.stop < *scenario.start) {
    experiment->fail(fmt::format("the run would end at {} s, before it starts ({} s)",
                                 core::to_text(*scenario.stop), core::to_text(*scenario.start)),
                     "give a stopTime that is not below the startTime");
  }
}

void flatten(const ssp::SystemNode& system, std::vector<std::string>& warnings,
             Scenario& scenario) {
  ssp::FlatSystem flat = ssp::flatten(system, warnings);
  scenario.system = std::move(flat.declaration);
  if (!scenario.alone.empty()) scenario.system.components.front().where.line = 0;
  scenario.sources = std::move(flat.sources);
}

/// As it is without the parameters that are still unknown.
std::vector<ssp::ParameterValue> late_parameters(const ReadOptions& options,
                                                 const ssp::SystemNode& system,
                                                 Scenario& scenario) {
  if (!options.late_parameters) return {};
  std::vector<std::string> said_later;
  flatten(system, said_later, scenario);
  return options.late_parameters(scenario);
}

void add_parameters(std::vector<ssp::ParameterValue> values, const std::string& alone,
                    ssp::SystemNode& system) {
  for (ssp::ParameterValue& value : values) {
    value.name = core::with_component(alone, value.name);
    system.parameters.push_back(std::move(value));
  }
}

}  // namespace

std::string stem(const std::filesystem::path& path) {
  if (std::error_code error; !std::filesystem::is_directory(path, error)) return path.stem();
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(path, error);
  return (error ? path : folder).filename();
}

Scenario read_scenario(const std::filesystem::path& path, const ReadOptions& options) {
  refuse_unknown_name(path);
  Scenario scenario;
  scenario.path = path;
  scenario.files = options.files ? options.files : std::make_shared<ssp::Files>(options.find_unit);
  const std::filesystem::path file = scenario.files->scenario_file(path);
  const xml::Document document = scenario.files->document(file);
  const xml::Element root = document.root();
  ssp::check_system_description(root);
  scenario.name = root.required("name");
  scenario.ssp_version = root.required("version");
  ssp::SystemNode system = ssp::read_system(root, file, *scenario.files, scenario.warnings);
  if (scenario.files->is_alone(file)) scenario.alone = system.elements.front().name;
  add_parameters(options.parameters, scenario.alone, system);
  scenario.annotation = read_annotation(root);
  add_parameters(late_parameters(options, system, scenario), scenario.alone, system);
  flatten(system, scenario.warnings, scenario);
  const std::vector<std::string>& of_files = scenario.files->warnings();
  scenario.warnings.insert(scenario.warnings.begin(), of_files.begin(), of_files.end());
  read_default_experiment(root, scenario);
  if (!scenario.vendor_step) scenario.vendor_step = find_vendor_step(root);
  return scenario;
}

}  // namespace stride::scenario
