#include "master/importer/fmi3/fmi3_description.h"

#include <fmt/format.h>

#include "master/importer/common_description.h"
#include "master/importer/fmi3/fmi3_variables.h"

namespace stride::importer {
namespace {

void read_co_simulation(const xml::Element& element, core::UnitDescription& unit) {
  read_capabilities(element, unit);
  unit.has_event_mode = element.flag("hasEventMode");
  unit.can_save_state = element.flag("canGetAndSetFMUState");
  unit.can_serialize_state = element.flag("canSerializeFMUState");
  unit.may_return_early = element.flag("mightReturnEarlyFromDoStep");
  unit.provides_intermediate_update = element.flag("providesIntermediateUpdate");
  unit.provides_directional_derivatives = element.flag("providesDirectionalDerivatives");
  unit.fixed_internal_step = read_step_size(element, "fixedInternalStepSize");
}

core::ValueReference checked_reference(const xml::Element& element, core::ValueReference reference,
                                       const VariableIndex& index) {
  if (index.contains(reference)) return reference;
  element.fail(fmt::format("{} refers to the value reference {}, which no variable has",
                           element.tag(), reference));
}

std::vector<core::Unknown> read_unknowns(const xml::Element& structure, const char* name,
                                         const VariableIndex& index) {
  std::vector<core::Unknown> unknowns;
  for (const xml::Element& element : structure.children(name)) {
    core::Unknown& unknown = unknowns.emplace_back();
    unknown.reference = checked_reference(
        element, element.required_number<core::ValueReference>("valueReference"), index);
    if (!element.attribute("dependencies")) continue;
    unknown.dependencies = element.number_list<core::ValueReference>("dependencies");
    for (const auto known : *unknown.dependencies) checked_reference(element, known, index);
  }
  return unknowns;
}

/// The place of the output that an attribute names, if it is there.
std::optional<std::size_t> read_output(const xml::Element& element, const char* attribute,
                                       core::ValueType type, const core::UnitDescription& unit) {
  const auto name = element.attribute(attribute);
  if (!name) return std::nullopt;
  const auto place = unit.find(*name);
  const core::Variable* variable = place ? &unit.variables[*place] : nullptr;
  const bool fits = variable != nullptr && variable->type == type && variable->size == 1 &&
                    variable->causality == core::Causality::Output && !variable->is_clocked();
  if (fits) return place;
  element.fail(fmt::format("{}=\"{}\" of {} is {}; expected a scalar {} output without a clock",
                           attribute, *name, element.tag(),
                           place ? "another variable" : "no variable", core::name(type)));
}

/// What FMI has no word for, in the annotation that the unit kit writes.
void read_annotation(const xml::Element& root, core::UnitDescription& unit) {
  const auto annotations = root.child("Annotations");
  if (!annotations) return;
  for (const xml::Element& annotation : annotations->children("Annotation")) {
    if (annotation.attribute_or("type") != "org.stride.unit") continue;
    for (const xml::Element& element : annotation.children()) {
      if (!element.is("urn:org.stride:unit:1", "Unit")) continue;
      unit.may_reject = element.flag("mayReject", unit.may_reject);
      unit.split_invariant = element.flag("splitInvariant");
      unit.maximum_step = read_step_size(element, "maximumStep");
      unit.verdict = read_output(element, "verdict", core::ValueType::Boolean, unit);
      unit.verdict_text = read_output(element, "verdictText", core::ValueType::String, unit);
    }
  }
}

}  // namespace

void read_fmi3_description(const xml::Element& root, core::UnitDescription& unit) {
  unit.instantiation_token = root.given("instantiationToken");
  read_co_simulation(find_co_simulation(root), unit);
  const VariableIndex index = read_variables(root, unit.variables);
  const auto structure = root.child("ModelStructure");
  if (!structure) root.fail("<ModelStructure> is missing");
  unit.outputs = read_unknowns(*structure, "Output", index);
  unit.initial_unknowns = read_unknowns(*structure, "InitialUnknown", index);
  read_annotation(root, unit);
}

}  // namespace stride::importer
