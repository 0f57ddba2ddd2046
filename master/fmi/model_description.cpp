#include "master/fmi/model_description.h"

#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/fmi/model_variables.h"
#include "master/fmi/xml.h"

namespace stride::fmi {
namespace {

void check_version(const Element& root) {
  if (root.name() != "fmiModelDescription") {
    root.fail(fmt::format("the document is a <{}>; expected <fmiModelDescription>", root.name()));
  }
  const std::string version = root.required_text("fmiVersion");
  if (version.starts_with("3.")) return;
  if (version.starts_with("2.")) {
    root.fail("FMI 2.0 units are not supported yet", "export the unit as FMI 3.0 Co-Simulation");
  }
  root.fail(fmt::format("fmiVersion=\"{}\" is not supported; expected 3.0", version),
            "export the unit as FMI 3.0 Co-Simulation");
}

Element find_co_simulation(const Element& root) {
  if (const auto found = root.child("CoSimulation")) return *found;
  std::vector<std::string> others;
  for (const char* other : {"ModelExchange", "ScheduledExecution"}) {
    if (root.child(other)) others.emplace_back(other);
  }
  root.fail(
      fmt::format("the unit has no Co-Simulation interface, which stride needs; it has {}",
                  others.empty() ? "none at all" : fmt::format("{}", fmt::join(others, ", "))),
      "export the unit for Co-Simulation");
}

/// It becomes a file's name, so it must not be able to name another folder.
std::string read_model_identifier(const Element& co_simulation) {
  const std::string identifier = co_simulation.required_text("modelIdentifier");
  const bool is_plain =
      !identifier.empty() && identifier.front() != '.' && identifier.find('/') == std::string::npos;
  if (!is_plain) {
    co_simulation.fail(fmt::format(
        "modelIdentifier=\"{}\": expected the plain name of the unit's library", identifier));
  }
  return identifier;
}

/// Nothing if there is no such attribute.
std::optional<Duration> read_seconds(const Element& element, const char* attribute) {
  const auto seconds = element.number<double>(attribute);
  if (!seconds) return std::nullopt;
  try {
    return duration_from_seconds(*seconds);
  } catch (const std::out_of_range& error) {
    element.fail(fmt::format("{}=\"{}\" of <{}>: {}", attribute, *element.text(attribute),
                             element.name(), error.what()));
  }
}

std::optional<Duration> read_step_size(const Element& element, const char* attribute) {
  const auto size = read_seconds(element, attribute);
  if (!size || *size > Duration{}) return size;
  element.fail(
      fmt::format("{}=\"{}\" of <{}>: expected a positive number of seconds, at least the "
                  "picosecond that times are counted in",
                  attribute, *element.text(attribute), element.name()));
}

void read_co_simulation(const Element& element, core::UnitDescription& unit) {
  unit.model_identifier = read_model_identifier(element);
  unit.has_event_mode = element.flag("hasEventMode");
  unit.can_save_state = element.flag("canGetAndSetFMUState");
  unit.can_serialize_state = element.flag("canSerializeFMUState");
  unit.can_vary_step = element.flag("canHandleVariableCommunicationStepSize");
  unit.may_return_early = element.flag("mightReturnEarlyFromDoStep");
  unit.single_instance = element.flag("canBeInstantiatedOnlyOncePerProcess");
  unit.needs_execution_tool = element.flag("needsExecutionTool");
  unit.provides_intermediate_update = element.flag("providesIntermediateUpdate");
  unit.max_output_derivative_order =
      element.number<unsigned>("maxOutputDerivativeOrder").value_or(0);
  unit.fixed_internal_step = read_step_size(element, "fixedInternalStepSize");
}

core::BaseUnit read_base_unit(const Element& element) {
  constexpr const char* kQuantities[] = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
  core::BaseUnit base;
  for (std::size_t i = 0; i < base.exponents.size(); ++i) {
    base.exponents[i] = element.number<int>(kQuantities[i]).value_or(0);
  }
  base.factor = element.number<double>("factor").value_or(1);
  base.offset = element.number<double>("offset").value_or(0);
  if (base.factor == 0) element.fail("factor=\"0\" of <BaseUnit>: a unit cannot be zero");
  return base;
}

void read_units(const Element& root, core::UnitDescription& unit) {
  const auto definitions = root.child("UnitDefinitions");
  if (!definitions) return;
  for (const Element& definition : definitions->children("Unit")) {
    const std::string name = definition.required_text("name");
    if (const auto base = definition.child("BaseUnit")) unit.units[name] = read_base_unit(*base);
  }
}

core::ValueReference checked_reference(const Element& element, core::ValueReference reference,
                                       const VariableIndex& index) {
  if (index.contains(reference)) return reference;
  element.fail(fmt::format("<{}> refers to the value reference {}, which no variable has",
                           element.name(), reference));
}

std::vector<core::Unknown> read_unknowns(const Element& structure, const char* name,
                                         const VariableIndex& index) {
  std::vector<core::Unknown> unknowns;
  for (const Element& element : structure.children(name)) {
    core::Unknown& unknown = unknowns.emplace_back();
    unknown.reference = checked_reference(
        element, element.required_number<core::ValueReference>("valueReference"), index);
    if (!element.text("dependencies")) continue;
    unknown.dependencies = element.number_list<core::ValueReference>("dependencies");
    for (const auto known : *unknown.dependencies) checked_reference(element, known, index);
  }
  return unknowns;
}

void read_default_experiment(const Element& root, core::UnitDescription& unit) {
  const auto experiment = root.child("DefaultExperiment");
  if (!experiment) return;
  unit.default_step = read_step_size(*experiment, "stepSize");
  const Duration start = read_seconds(*experiment, "startTime").value_or(Duration{});
  const auto stop = read_seconds(*experiment, "stopTime");
  if (!stop) return;
  if (*stop <= start) {
    experiment->fail(
        fmt::format("stopTime=\"{}\" of <DefaultExperiment>: expected a time at least a "
                    "picosecond after the start, {} s",
                    *experiment->text("stopTime"), core::to_text(Time(start))));
  }
  unit.default_stop = Time(*stop);
}

/// What FMI has no word for, in the annotation that the unit kit writes.
void read_annotation(const Element& root, core::UnitDescription& unit) {
  const auto annotations = root.child("Annotations");
  if (!annotations) return;
  for (const Element& annotation : annotations->children("Annotation")) {
    if (annotation.text_or("type") != "org.stride.unit") continue;
    for (const Element& element : annotation.children()) {
      if (!element.is("urn:org.stride:unit:1", "Unit")) continue;
      unit.may_reject = element.flag("mayReject", unit.may_reject);
      unit.split_invariant = element.flag("splitInvariant");
      unit.maximum_step = read_step_size(element, "maximumStep");
    }
  }
}

core::UnitDescription read(const Element& root) {
  check_version(root);
  core::UnitDescription unit;
  unit.fmi_version = root.required_text("fmiVersion");
  unit.model_name = root.required_text("modelName");
  unit.instantiation_token = root.required_text("instantiationToken");
  unit.description = root.text_or("description");
  unit.generation_tool = root.text_or("generationTool");
  read_co_simulation(find_co_simulation(root), unit);
  read_units(root, unit);
  const VariableIndex index = read_variables(root, unit.variables);
  const auto structure = root.child("ModelStructure");
  if (!structure) root.fail("<ModelStructure> is missing");
  unit.outputs = read_unknowns(*structure, "Output", index);
  unit.initial_unknowns = read_unknowns(*structure, "InitialUnknown", index);
  read_default_experiment(root, unit);
  read_annotation(root, unit);
  return unit;
}

}  // namespace

core::UnitDescription parse_model_description(const std::string& text,
                                              const std::string& shown_as) {
  return read(Document(text, shown_as).root());
}

core::UnitDescription read_model_description(const std::filesystem::path& xml,
                                             const std::string& shown_as) {
  const std::string name = shown_as.empty() ? xml.string() : shown_as;
  return parse_model_description(read_text(xml, "model description", name), name);
}

}  // namespace stride::fmi
