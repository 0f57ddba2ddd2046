#include "master/system/declaration/annotation.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/number_text.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/system/declaration/intervention_element.h"
#include "master/system/declaration/parse_attribute.h"
#include "master/system/ssp/ssp.h"

namespace stride::scenario {
namespace {

/// An annotation of another type that was meant to be ours, by its elements or nearly by its type.
void check_foreign(const xml::Element& annotation) {
  const std::string type = annotation.attribute("type").value_or("");
  const std::string own[] = {ssp::kStrideAnnotation};
  bool is_meant = !core::nearest(type, own).empty();
  for (const xml::Element& child : annotation.children()) {
    is_meant |= child.local_name() == "Scenario" && child.prefix_of(ssp::kStrideScenario);
  }
  if (!is_meant) return;
  annotation.fail(fmt::format("the type of this annotation is '{}', so it would be ignored", type),
                  fmt::format("write type=\"{}\"", ssp::kStrideAnnotation));
}

void collect(const xml::Element& element, std::vector<xml::Element>& found) {
  if (element.local_name() == "Annotation") {  // those of other tools may hold anything
    if (element.attribute("type") != ssp::kStrideAnnotation) {
      check_foreign(element);
      return;
    }
    if (!element.is(ssp::kSsc, "Annotation")) {
      element.fail(
          fmt::format("this is an <Annotation> of the namespace '{}', so it would be ignored",
                      element.name().name_space),
          fmt::format("write <ssc:Annotation> with xmlns:ssc=\"{}\"", ssp::kSsc));
    }
    found.push_back(element);
    return;
  }
  for (const xml::Element& child : element.children()) collect(child, found);
}

bool is_of_root_or_system(const xml::Element& annotation, const xml::Element& root) {
  const auto annotations = annotation.parent();
  const auto owner = annotations ? annotations->parent() : std::nullopt;
  if (!owner) return false;
  if (owner->index() == root.index()) return true;
  const auto above = owner->parent();
  return owner->is(ssp::kSsd, "System") && above && above->index() == root.index();
}

using SetSetting = void (StepSettings::*)(std::string_view);

/// Attributes that each set one of the settings.
void read_settings(const xml::Element& element, StepSettings& settings,
                   std::initializer_list<std::pair<const char*, SetSetting>> attributes) {
  for (const auto& [name, set] : attributes) {
    if (!element.attribute(name)) continue;
    parse_attribute(element, name,
                    [&, set = set](const std::string& text) { (settings.*set)(text); });
  }
}

std::vector<ComponentPattern> read_components(const xml::Element& element) {
  std::vector<ComponentPattern> patterns;
  std::istringstream words(element.required("components"));
  for (std::string word; words >> word;) patterns.push_back({word, element.where()});
  return patterns;
}

/// A step of some components alone.
void read_component_step(const xml::Element& element, StepSettings& settings) {
  element.allow_attributes({"components", "size"});
  element.allow_children({});
  element.required("size");
  StepSettings own;
  read_settings(element, own, {{"size", &StepSettings::set_size}});
  for (auto& pattern : read_components(element)) {
    settings.of_components.push_back({std::move(pattern), *own.size});
  }
}

/// That of the run, without `components`, which another name may stand for.
void read_step(const xml::Element& element, StepSettings& settings) {
  element.allow_attributes({"components", "policy", "size", "maximum", "minimum",
                            "relativeTolerance", "absoluteTolerance"});
  element.allow_children({});
  read_settings(element, settings,
                {{"policy", &StepSettings::set_policy},
                 {"size", &StepSettings::set_size},
                 {"maximum", &StepSettings::set_maximum},
                 {"minimum", &StepSettings::set_minimum},
                 {"relativeTolerance", &StepSettings::set_relative_tolerance},
                 {"absoluteTolerance", &StepSettings::set_absolute_tolerance}});
}

void read_step_element(const xml::Element& element, ScenarioAnnotation& annotation) {
  if (element.attribute("components")) return read_component_step(element, annotation.step);
  if (annotation.step_where) {
    element.fail(fmt::format("a second {}; the first is in line {}", element.tag(),
                             annotation.step_where->line),
                 "join them, or name the components of one, components=\"…\"");
  }
  annotation.step_where = element.where();
  read_step(element, annotation.step);
}

void read_exchange(const xml::Element& element, StepSettings& settings) {
  element.allow_attributes({"coupling", "extrapolation"});
  element.allow_children({});
  read_settings(element, settings,
                {{"coupling", &StepSettings::set_coupling},
                 {"extrapolation", &StepSettings::set_extrapolation}});
}

/// What the attribute `signals` lists.
std::vector<SignalPattern> read_signals(const xml::Element& element) {
  std::vector<SignalPattern> patterns;
  std::istringstream words(element.required("signals"));
  for (std::string word; words >> word;) patterns.push_back({word, element.where()});
  return patterns;
}

void read_record(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes({"signals"});
  element.allow_children({});
  for (auto& pattern : read_signals(element)) annotation.record.push_back(std::move(pattern));
}

void read_plot(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes({"title", "signals"});
  element.allow_children({});
  PlotPattern plot{element.required("title"), read_signals(element)};
  if (plot.signals.empty()) element.fail("the plot shows nothing", "name its signals");
  annotation.plots.push_back(std::move(plot));
}

void read_main_thread(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes({"components"});
  element.allow_children({});
  for (auto& pattern : read_components(element)) annotation.main_thread.push_back(pattern);
}

void read_permission(const xml::Element& element, std::vector<PermissionRule>& rules) {
  element.allow_attributes({"components", "allowed"});
  element.allow_children({});
  element.required("allowed");
  const bool allowed = element.flag("allowed", true);
  for (auto& pattern : read_components(element)) rules.push_back({pattern, allowed});
}

void read_state_saving(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes({"components", "allowed", "eachStep"});
  element.allow_children({});
  if (!element.attribute("eachStep")) element.required("allowed");
  for (auto& pattern : read_components(element)) {
    if (element.attribute("allowed")) {
      annotation.state_saving.push_back({pattern, element.flag("allowed", true)});
    }
    if (element.attribute("eachStep")) {
      annotation.repeated_steps.push_back({pattern, !element.flag("eachStep", false)});
    }
  }
}

/// Attributes that only mean something of a unit on another machine.
constexpr const char* kRemoteAttributes[] = {"fmu", "send", "stride", "connectLimit",
                                             "silenceLimit"};

std::optional<RemoteSettings> read_place(const xml::Element& element) {
  if (!element.attribute("at")) {
    for (const char* attribute : kRemoteAttributes) {
      if (!element.attribute(attribute)) continue;
      element.fail(fmt::format("{} is for a unit on another machine", attribute),
                   "name it, at=\"ssh://user@machine\", or leave the attribute out");
    }
    return std::nullopt;
  }
  RemoteSettings remote;
  remote.where = element.where();
  remote.place = parse_attribute(element, "at", [&](const std::string& text) {
    return remote::parse_place(text, element.attribute("stride").value_or(""));
  });
  remote.fmu = element.attribute("fmu");
  remote.sends = element.flag("send");
  if (remote.fmu && remote.sends) {
    element.fail("fmu names an FMU of that machine, and send=\"true\" sends one of this machine",
                 "leave one of them out");
  }
  if (element.attribute("connectLimit")) {
    remote.connect_limit = parse_attribute(element, "connectLimit", parse_call_limit);
  }
  if (element.attribute("silenceLimit")) {
    remote.silence_limit = parse_attribute(element, "silenceLimit", parse_call_limit);
  }
  return remote;
}

void read_host(const xml::Element& element, HostRules& hosts) {
  element.allow_attributes({"components", "process", "timeout", "memoryLimit", "sandbox",
                            "snapshots", "at", "fmu", "send", "stride", "connectLimit",
                            "silenceLimit"});
  element.allow_children({});
  HostSettings settings;
  settings.process = element.flag("process", true);
  settings.where = element.where();
  settings.remote = read_place(element);
  for (const char* attribute : {"timeout", "memoryLimit", "sandbox", "snapshots", "at"}) {
    if (*settings.process || !element.attribute(attribute)) continue;
    element.fail(fmt::format("{} is for a unit with a process of its own", attribute),
                 "leave it out, or process=\"false\"");
  }
  if (element.attribute("timeout")) {
    settings.call_limit = parse_attribute(element, "timeout", parse_call_limit);
  }
  if (element.attribute("memoryLimit")) {
    settings.memory_limit = parse_attribute(element, "memoryLimit", parse_memory_limit);
  }
  if (element.attribute("sandbox")) settings.sandbox = element.flag("sandbox");
  if (element.attribute("snapshots")) settings.snapshots = element.flag("snapshots");
  for (auto& pattern : read_components(element)) hosts.rules.push_back({pattern, settings});
}

void read_idle_skip(const xml::Element& element, IdleSettings& settings) {
  element.allow_attributes({"components", "enabled", "maxSkip"});
  element.allow_children({});
  IdleRule rule{{}, element.flag("enabled", true), std::nullopt, element.where()};
  if (element.attribute("maxSkip")) {
    rule.max_skip = parse_attribute(element, "maxSkip", parse_max_skip);
  }
  std::vector<ComponentPattern> patterns{{"*", element.where()}};
  if (element.attribute("components")) patterns = read_components(element);
  for (ComponentPattern& pattern : patterns) {
    rule.components = std::move(pattern);
    settings.rules.push_back(rule);
  }
}

/// <Deadband variable="…" value="…"/>, and the same for a tolerance.
IdleNumber read_idle_number(const xml::Element& element, double (*parse)(std::string_view)) {
  element.allow_attributes({"variable", "value"});
  element.allow_children({});
  return {element.required("variable"), parse_attribute(element, "value", parse), element.where()};
}

void read_own_intervention(const xml::Element& element, ScenarioAnnotation& annotation) {
  annotation.interventions.push_back(read_intervention(element));
}

void read_terminal_connection(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes({"startElement", "startTerminal", "endElement", "endTerminal"});
  element.allow_children({});
  annotation.terminals.push_back({element.required("startElement"),
                                  element.required("startTerminal"), element.required("endElement"),
                                  element.required("endTerminal"), element.where()});
}

void check_file_name(const xml::Element& element, const char* attribute, const std::string& name) {
  if (!recorders::is_plain_file_name(name)) {
    element.fail(fmt::format("{}=\"{}\" is not a plain file name", attribute, name),
                 "the file goes into the results folder, so give its name only");
  }
  if (name == recorders::kUnitsFolder) {
    element.fail(fmt::format("{}=\"{}\" is the name of a folder of the results", attribute, name),
                 "units write their own files there, so choose another name");
  }
}

void read_results(const xml::Element& element, ScenarioAnnotation& annotation) {
  element.allow_attributes(
      {"signals", "events", "trace", "activity", "statistics", "report", "coverage"});
  element.allow_children({});
  std::set<std::string> taken;
  for (const auto& [attribute, member] : recorders::kResultFiles) {
    std::string& file = annotation.results.*member;
    if (element.attribute(attribute)) file = element.required(attribute);
    if (file == "none") file.clear();
    check_file_name(element, attribute, file);
    if (file.empty() || taken.insert(file).second) continue;
    element.fail(fmt::format("two results have the file name '{}'", file),
                 "give each a name of its own, or write \"none\" to leave it out");
  }
}

/// A child of <stride:Scenario>.
struct ScenarioElement {
  std::string_view name;
  bool may_repeat;
  void (*read)(const xml::Element& element, ScenarioAnnotation& annotation);
};

constexpr ScenarioElement kElements[] = {
    {"Step", true, [](const auto& element, auto& to) { read_step_element(element, to); }},
    {"Exchange", false, [](const auto& element, auto& to) { read_exchange(element, to.step); }},
    {"Record", true, read_record},
    {"Checks", false,
     [](const auto& element, auto& to) {
       to.checks = read_checks(element);
       to.covered = read_covered(element);
     }},
    {"Coverage", false,
     [](const auto& element, auto& to) { to.coverage = read_coverage(element); }},
    {"Results", false, read_results},
    {"Plot", true, read_plot},
    {"MainThread", true, read_main_thread},
    {"EarlyReturn", true,
     [](const auto& element, auto& to) { read_permission(element, to.early_return); }},
    {"StateSaving", true, read_state_saving},
    {"Host", true, [](const auto& element, auto& to) { read_host(element, to.hosts); }},
    {"IdleSkip", true, [](const auto& element, auto& to) { read_idle_skip(element, to.idle); }},
    {"Deadband", true,
     [](const auto& element, auto& to) {
       to.idle.deadbands.push_back(read_idle_number(element, core::parse_at_least_zero));
     }},
    {"Tolerance", true,
     [](const auto& element, auto& to) {
       to.idle.tolerances.push_back(read_idle_number(element, core::parse_above_zero));
     }},
    {"Set", true, read_own_intervention},
    {"Force", true, read_own_intervention},
    {"Drop", true, read_own_intervention},
    {"Delay", true, read_own_intervention},
    {"Corrupt", true, read_own_intervention},
    {"TerminalConnection", true, read_terminal_connection},
};

template <std::size_t... i>
void allow_elements(const xml::Element& scenario, std::index_sequence<i...>) {
  scenario.allow_children({xml::Name(ssp::kStrideScenario, kElements[i].name)...});
}

ScenarioAnnotation read_scenario_element(const xml::Element& scenario) {
  scenario.allow_attributes({});
  allow_elements(scenario, std::make_index_sequence<std::size(kElements)>());
  ScenarioAnnotation annotation;
  for (const ScenarioElement& kind : kElements) {
    const xml::Name name(ssp::kStrideScenario, kind.name);
    if (!kind.may_repeat) scenario.child(name);  // two are an error
    for (const xml::Element& element : scenario.children(name)) kind.read(element, annotation);
  }
  return annotation;
}

}  // namespace

ScenarioAnnotation read_annotation(const xml::Element& root) {
  std::vector<xml::Element> found;
  collect(root, found);
  for (const xml::Element& annotation : found) {
    if (is_of_root_or_system(annotation, root)) continue;
    annotation.fail(
        fmt::format("an annotation of the type '{}' does not belong here", ssp::kStrideAnnotation),
        "move it to the <Annotations> at the end of <SystemStructureDescription>");
  }
  if (found.empty()) return {};
  if (found.size() > 1) {
    found[1].fail(fmt::format("a second annotation of the type '{}'; the first is in line {}",
                              ssp::kStrideAnnotation, found[0].where().line),
                  "put everything into one <stride:Scenario>");
  }
  found[0].allow_attributes({"type"});
  found[0].allow_children({{ssp::kStrideScenario, "Scenario"}});
  const auto scenario = found[0].child({ssp::kStrideScenario, "Scenario"});
  if (!scenario) {
    found[0].fail(
        fmt::format("the annotation of the type '{}' holds no <stride:Scenario>",
                    ssp::kStrideAnnotation),
        fmt::format("write <stride:Scenario xmlns:stride=\"{}\"> into it", ssp::kStrideScenario));
  }
  return read_scenario_element(*scenario);
}

}  // namespace stride::scenario
