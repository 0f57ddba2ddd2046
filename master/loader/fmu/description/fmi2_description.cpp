#include "master/loader/fmu/description/fmi2_description.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/fmu/description/common_description.h"
#include "master/loader/fmu/description/variable_attributes.h"

namespace stride::importer {
namespace {

using core::Causality;
using core::ValueType;
using core::Variability;

void read_fmi2_co_simulation(const xml::Element& element, core::UnitDescription& unit) {
  read_capabilities(element, unit);
  unit.can_save_state = element.lenient_flag("canGetAndSetFMUstate", unit.warnings);
  unit.can_serialize_state = element.lenient_flag("canSerializeFMUstate", unit.warnings);
  unit.provides_intermediate_update = element.lenient_flag("canInterpolateInputs", unit.warnings);
  unit.provides_directional_derivatives =
      element.lenient_flag("providesDirectionalDerivative", unit.warnings);
}

/// The five elements that give a variable or a declared type its type.
std::optional<ValueType> find_type(const xml::Element& element) {
  constexpr std::pair<const char*, ValueType> kTypes[] = {
      {"Real", ValueType::Float64},
      {"Integer", ValueType::Int32},
      {"Boolean", ValueType::Boolean},
      {"String", ValueType::String},
      {"Enumeration", ValueType::Enumeration},
  };
  for (const auto& [name, type] : kTypes) {
    if (element.is("", name)) return type;
  }
  return std::nullopt;
}

/// That one of them which an element has as a child.
xml::Element type_element(const xml::Element& parent) {
  for (const xml::Element& child : parent.children()) {
    if (find_type(child)) return child;
  }
  parent.fail(fmt::format("{} has none of <Real>, <Integer>, <Boolean>, <String>, <Enumeration>",
                          parent.tag()));
}

/// Reads <ModelVariables>.
class Variables {
 public:
  Variables(const xml::Element& root, core::UnitDescription& unit)
      : unit_(unit), types_(unit.warnings), names_(unit) {
    const auto list = root.child("ModelVariables");
    if (!list) root.fail("<ModelVariables> is missing");
    read_types(root);
    for (const xml::Element& element : list->children("ScalarVariable")) add(element);
  }

  /// Those of the unit, in the order of the variables.
  const std::vector<fmi2ValueReference>& references() const { return references_; }
  /// The index of the variable of each <ScalarVariable>, in their order.
  const std::vector<core::ValueReference>& places() const { return places_; }

 private:
  void read_types(const xml::Element& root) {
    const auto definitions = root.child("TypeDefinitions");
    if (!definitions) return;
    for (const xml::Element& definition : definitions->children("SimpleType")) {
      types_.add(definition, type_element(definition));
    }
  }

  void add(const xml::Element& element) {
    const auto reference = element.required_number<fmi2ValueReference>("valueReference");
    core::Variable variable = read(element);
    const auto is_same = [&](std::size_t first) {
      return references_[first] == reference &&
             are_declared_alike(unit_.variables[first], variable);
    };
    const auto first = names_.add(variable.name, element, is_same);
    places_.push_back(static_cast<core::ValueReference>(first.value_or(unit_.variables.size())));
    if (first) return;
    variable.reference = places_.back();
    if (variable.causality == Causality::Input) check_input(element, variable, reference);
    note_unit(element, variable, reference);
    references_.push_back(reference);
    unit_.variables.push_back(std::move(variable));
  }

  core::Variable read(const xml::Element& element) const {
    const xml::Element typed = type_element(element);
    core::Variable variable;
    variable.name = element.required("name");
    variable.description = element.attribute_or("description");
    variable.type = *find_type(typed);
    variable.causality = read_causality(element, unit_.warnings);
    if (variable.causality == Causality::StructuralParameter) {
      element.fail("causality=\"structuralParameter\": there are none in FMI 2.0");
    }
    variable.variability = variability(element, variable);
    variable.initial = read_initial(element, variable);
    variable.start = typed.attribute_or("start");
    const auto declared = declared_type(typed);
    if (variable.type == ValueType::Enumeration) {
      if (!declared) TypeDefinitions::fail_without(typed);
      variable.items = read_items(*declared);
    }
    check_start(typed, variable, unit_.warnings);
    read_unit(typed, declared, variable, unit_.warnings);
    variable.min = inherited(typed, declared, "min");
    variable.max = inherited(typed, declared, "max");
    check_limits(typed, variable, unit_.warnings);
    variable.nominal = read_nominal(typed, variable.type, declared);
    variable.intermediate_update = unit_.provides_intermediate_update &&
                                   variable.causality == Causality::Input &&
                                   variable.variability == Variability::Continuous;
    return variable;
  }

  /// To FMI 2.0 "continuous" is the default, of an Integer as well, which cannot be.
  Variability variability(const xml::Element& element, const core::Variable& variable) const {
    const Variability declared =
        read_variability(element, variable.type, variable.causality, unit_.warnings);
    const bool is_possible =
        declared != Variability::Continuous || variable.type == ValueType::Float64;
    return is_possible ? declared : Variability::Discrete;
  }

  std::optional<xml::Element> declared_type(const xml::Element& typed) const {
    const auto type = types_.declared(typed);
    if (!type || type->name() == typed.name()) return type;
    typed.fail(fmt::format("declaredType=\"{}\" is a {}; expected a {}",
                           *typed.attribute("declaredType"), type->tag(), typed.tag()));
  }

  /// One of them would take the other's values away.
  void check_input(const xml::Element& element, const core::Variable& variable,
                   fmi2ValueReference reference) {
    const bool is_integer = variable.type == ValueType::Enumeration;
    const ValueType base = is_integer ? ValueType::Int32 : variable.type;
    const auto [same, is_new] = inputs_.emplace(std::pair(base, reference), variable.name);
    if (is_new) return;
    element.fail(fmt::format("the input '{}' has the value reference {} of the input '{}'",
                             variable.name, reference, same->second));
  }

  /// One number cannot be in two units of measure.
  void note_unit(const xml::Element& element, const core::Variable& variable,
                 fmi2ValueReference reference) {
    if (variable.type != ValueType::Float64 || variable.unit.empty()) return;
    const auto [same, is_new] = units_.emplace(reference, std::pair(variable.name, variable.unit));
    const auto& [name, unit] = same->second;
    if (unit == variable.unit) return;
    unit_.warnings.push_back(
        core::to_text({.where = element.where()}) +
        fmt::format("'{}' has the value of '{}', by its valueReference, and another unit of "
                    "measure, '{}', not '{}': each is taken for what it says",
                    variable.name, name, variable.unit, unit));
  }

  core::UnitDescription& unit_;
  std::vector<fmi2ValueReference> references_;
  std::map<fmi2ValueReference, std::pair<std::string, std::string>> units_;  ///< first names
  std::vector<core::ValueReference> places_;
  TypeDefinitions types_;
  VariableNames names_;
  std::map<std::pair<ValueType, fmi2ValueReference>, std::string> inputs_;
};

/// The index of the variable of each <ScalarVariable>.
using Places = std::vector<core::ValueReference>;

/// From an index of ModelStructure, which counts the elements from 1.
core::ValueReference to_reference(const xml::Element& unknown, core::ValueReference index,
                                  const Places& places) {
  if (index >= 1 && index <= places.size()) return places[index - 1];
  unknown.fail(fmt::format("{} refers to the variable with the index {}; expected one from 1 to {}",
                           unknown.tag(), index, places.size()));
}

std::vector<core::Unknown> read_unknowns(const xml::Element& structure, const char* list,
                                         const Places& places) {
  std::vector<core::Unknown> unknowns;
  const auto parent = structure.child(list);
  if (!parent) return unknowns;
  for (const xml::Element& element : parent->children("Unknown")) {
    core::Unknown& unknown = unknowns.emplace_back();
    unknown.reference =
        to_reference(element, element.required_number<core::ValueReference>("index"), places);
    if (!element.attribute("dependencies")) continue;
    unknown.dependencies = element.number_list<core::ValueReference>("dependencies");
    for (auto& known : *unknown.dependencies) known = to_reference(element, known, places);
  }
  return unknowns;
}

}  // namespace

Fmi2Attributes read_fmi2_description(const xml::Element& root, core::UnitDescription& unit) {
  unit.instantiation_token = root.given("guid");
  const xml::Element co_simulation = find_co_simulation(root, unit.warnings);
  read_fmi2_co_simulation(co_simulation, unit);
  Fmi2Attributes attributes;
  attributes.can_run_asynchronously =
      co_simulation.lenient_flag("canRunAsynchronuously", unit.warnings);  // as it is spelt there
  const Variables variables(root, unit);
  attributes.references = variables.references();
  mark_aliases(attributes.references, unit.variables);
  const Places& places = variables.places();
  const auto reader = [&places](const char* list) {
    return
        [&places, list](const auto& structure) { return read_unknowns(structure, list, places); };
  };
  read_model_structure(root, unit, reader("Outputs"), reader("InitialUnknowns"));
  return attributes;
}

}  // namespace stride::importer
