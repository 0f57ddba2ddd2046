#include "master/io/scenario.h"

#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/io/ssp.h"
#include "master/io/system_reader.h"
#include "master/io/time_text.h"
#include "master/xml/document.h"

namespace stride::io {
namespace {

/// What a file of another kind is, so that the error can say so.
std::string kind_of(const xml::Name& root) {
  constexpr std::array<std::pair<xml::Name, const char*>, 4> kKinds{
      {{{kSsv, "ParameterSet"}, "a parameter set (.ssv)"},
       {{kSsm, "ParameterMapping"}, "a parameter mapping (.ssm)"},
       {{kSsb, "SignalDictionary"}, "a signal dictionary (.ssb)"},
       {{"", "fmiModelDescription"}, "the model description of an FMU"}}};
  for (const auto& [name, kind] : kKinds) {
    if (name == root) return kind;
  }
  if (root.local == "SystemStructureDescription") {
    return fmt::format("a <SystemStructureDescription> of the namespace '{}'", root.name_space);
  }
  return fmt::format("an XML file with the root element <{}>", root.local);
}

void check_root(const xml::Element& root) {
  if (!root.is(kSsd, "SystemStructureDescription")) {
    root.fail(fmt::format("this is {}, expected a system structure description (.ssd)",
                          kind_of(root.name())),
              fmt::format("its root element is <SystemStructureDescription> of the namespace '{}'",
                          kSsd));
  }
  root.allow_attributes({"version", "name", "author", "fileversion", "copyright", "license",
                         "generationTool", "generationDateAndTime"});
  const std::string version = root.required("version");
  if (version != "1.0" && version != "2.0") {
    root.fail(fmt::format("the SSP version '{}' is not known", version),
              "stride reads 1.0 and 2.0");
  }
  root.allow_children({{kSsd, "System"},
                       {kSsd, "Enumerations"},
                       {kSsd, "Units"},
                       {kSsd, "DefaultExperiment"},
                       {kSsc, "MetaData"},
                       {kSsc, "Signature"},
                       {kSsd, "Annotations"}});
}

std::optional<Time> read_time(const xml::Element& element, const char* attribute) {
  const auto text = element.attribute(attribute);
  if (!text) return std::nullopt;
  try {
    return Time(parse_seconds(*text));
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("{}={}", attribute, mistake.what()));
  }
}

void read_default_experiment(const xml::Element& root, Scenario& scenario) {
  const auto experiment = root.child({kSsd, "DefaultExperiment"});
  if (!experiment) return;
  experiment->allow_attributes({"startTime", "stopTime"});
  experiment->allow_children({{kSsd, "Annotations"}});
  scenario.start = read_time(*experiment, "startTime");
  scenario.stop = read_time(*experiment, "stopTime");
  if (scenario.stop && *scenario.stop <= scenario.start.value_or(Time{})) {
    experiment->fail(
        fmt::format("the run would end at {} s, before or where it starts ({} s)",
                    core::to_text(*scenario.stop), core::to_text(scenario.start.value_or(Time{}))),
        "give a stopTime above the startTime");
  }
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& path) {
  const xml::Document document(path);
  const xml::Element root = document.root();
  check_root(root);
  Scenario scenario;
  scenario.path = path;
  scenario.name = root.required("name");
  scenario.ssp_version = root.required("version");
  const auto system = root.child({kSsd, "System"});
  if (!system) root.fail(fmt::format("{} holds no <System>", root.tag()));
  SystemContent content = read_system(*system, scenario.ssp_version, path.parent_path());
  scenario.system = std::move(content.declaration);
  scenario.sources = std::move(content.sources);
  read_default_experiment(root, scenario);
  scenario.annotation = read_annotation(root);
  return scenario;
}

}  // namespace stride::io
