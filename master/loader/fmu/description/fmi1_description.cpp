#include "master/loader/fmu/description/fmi1_description.h"

#include <map>
#include <optional>
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

/// The elements that give a variable its type, and those that declare one by name.
struct TypeElement {
  const char* name;
  const char* declared;
  ValueType type;
};

constexpr TypeElement kTypeElements[] = {
    {"Real", "RealType", ValueType::Float64},
    {"Integer", "IntegerType", ValueType::Int32},
    {"Boolean", "BooleanType", ValueType::Boolean},
    {"String", "StringType", ValueType::String},
    {"Enumeration", "EnumerationType", ValueType::Enumeration},
};

/// <CoSimulation_StandAlone>, which the unit must have.
xml::Element find_stand_alone(const xml::Element& root, std::vector<std::string>& warnings) {
  const auto implementation = root.lenient_child("Implementation", warnings);
  if (!implementation) {
    root.fail(
        "the unit has no Co-Simulation interface, which stride needs; it is for Model Exchange",
        "export the unit for Co-Simulation, with a solver of its own");
  }
  const char* const expected = "CoSimulation_StandAlone";
  if (const auto found = implementation->lenient_child(expected, warnings)) return *found;
  const bool is_of_tool = implementation->lenient_child("CoSimulation_Tool", warnings).has_value();
  implementation->fail(
      is_of_tool ? fmt::format("the unit couples stride to a tool; expected <{}>", expected)
                 : fmt::format("{} has no <{}>", implementation->tag(), expected),
      "export the unit for stand-alone Co-Simulation");
}

/// Returns whether it can reject steps. Any unit may complete a step in part.
bool read_fmi1_capabilities(const xml::Element& stand_alone, core::UnitDescription& unit) {
  const auto capabilities = stand_alone.child("Capabilities");
  if (!capabilities) return false;
  unit.can_vary_step =
      capabilities->lenient_flag("canHandleVariableCommunicationStepSize", unit.warnings);
  unit.single_instance =
      capabilities->lenient_flag("canBeInstantiatedOnlyOncePerProcess", unit.warnings);
  return capabilities->lenient_flag("canRejectSteps", unit.warnings);
}

/// Reads <ModelVariables>.
class Fmi1Variables {
 public:
  Fmi1Variables(const xml::Element& root, core::UnitDescription& unit)
      : unit_(unit), types_(unit.warnings), names_(unit) {
    const auto list = root.child("ModelVariables");
    if (!list) root.fail("<ModelVariables> is missing");
    read_types(root);
    std::vector<xml::Element> elements = list->children("ScalarVariable");
    std::erase_if(elements, [this](const xml::Element& element) { return !add(element); });
    for (const xml::Element& element : elements) add_output(element);
  }

  const Fmi1Attributes& attributes() const { return attributes_; }

 private:
  void read_types(const xml::Element& root) {
    const auto definitions = root.child("TypeDefinitions");
    if (!definitions) return;
    for (const xml::Element& definition : definitions->children("Type")) {
      for (const TypeElement& known : kTypeElements) {
        if (const auto type = definition.child(known.declared)) types_.add(definition, *type);
      }
    }
  }

  /// Returns whether it is there now.
  bool add(const xml::Element& element) {
    core::Variable variable = read(element);
    const bool is_negated = element.attribute("alias") == "negatedAlias";
    if (is_negated && !can_be_negated(variable.type)) {
      unit_.warnings.push_back(core::to_text({.where = element.where()}) +
                               fmt::format("'{}' is left out: no {} can be a negatedAlias",
                                           variable.name, core::name(variable.type)));
      return false;
    }
    const auto reference = element.required_number<fmi1ValueReference>("valueReference");
    const auto is_same = [&](std::size_t first) {
      return attributes_.references[first] == reference &&
             attributes_.negated[first] == is_negated &&
             are_declared_alike(unit_.variables[first], variable);
    };
    if (names_.add(variable.name, element, is_same)) return false;
    variable.reference = static_cast<core::ValueReference>(unit_.variables.size());
    places_.emplace(variable.name, variable.reference);
    attributes_.references.push_back(reference);
    attributes_.negated.push_back(is_negated);
    variable.is_negated = is_negated;
    unit_.variables.push_back(std::move(variable));
    return true;
  }

  static bool can_be_negated(ValueType type) {
    return type == ValueType::Float64 || type == ValueType::Int32 || type == ValueType::Boolean;
  }

  core::Variable read(const xml::Element& element) const {
    const auto [typed, type] = type_of(element);
    core::Variable variable;
    variable.name = element.required("name");
    variable.description = element.attribute_or("description");
    variable.type = type;
    read_kind(element, variable);
    variable.start = typed.attribute_or("start");
    const auto declared = types_.declared(typed);
    if (type == ValueType::Enumeration && declared) variable.items = items_of(*declared);
    check_start(typed, variable, unit_.warnings);
    variable.initial = initial_of(typed, variable);
    read_unit(typed, declared, variable, unit_.warnings);
    variable.min = inherited(typed, declared, "min");
    variable.max = inherited(typed, declared, "max");
    check_limits(typed, variable, unit_.warnings);
    variable.nominal = read_nominal(typed, variable.type, declared);
    return variable;
  }

  static std::pair<xml::Element, ValueType> type_of(const xml::Element& variable) {
    for (const TypeElement& known : kTypeElements) {
      if (const auto typed = variable.child(known.name)) return {*typed, known.type};
    }
    variable.fail(fmt::format(
        "{} has none of <Real>, <Integer>, <Boolean>, <String>, <Enumeration>", variable.tag()));
  }

  /// FMI 1.0 has neither parameters nor local variables by name.
  void read_kind(const xml::Element& element, core::Variable& variable) const {
    const std::vector<std::string> causalities{"input", "output", "internal", "none"};
    const std::vector<std::string> variabilities{"constant", "parameter", "discrete", "continuous"};
    const std::string causality =
        element.lenient_word("causality", causalities, unit_.warnings).value_or("internal");
    const std::string variability =
        element.lenient_word("variability", variabilities, unit_.warnings).value_or("continuous");
    const bool is_real = variable.type == ValueType::Float64;
    variable.variability = variability == "constant"                ? Variability::Constant
                           : variability == "parameter"             ? Variability::Fixed
                           : is_real && variability == "continuous" ? Variability::Continuous
                                                                    : Variability::Discrete;
    variable.causality = causality == "output"        ? Causality::Output
                         : variability == "parameter" ? Causality::Parameter
                         : causality == "input"       ? Causality::Input
                                                      : Causality::Local;
  }

  /// What has a start value can be set before fmiInitializeSlave, which may replace a value that is
  /// no parameter or input (FMI 1.0 for Model Exchange, 3.3).
  static core::Initial initial_of(const xml::Element& typed, const core::Variable& variable) {
    if (variable.variability == Variability::Constant) return core::Initial::Exact;
    if (variable.causality == Causality::Parameter || variable.causality == Causality::Input) {
      return core::Initial::Exact;
    }
    const bool has_start = variable.type == ValueType::String ? typed.attribute("start").has_value()
                                                              : !variable.start.empty();
    return has_start ? core::Initial::Approx : core::Initial::Calculated;
  }

  /// They are numbered from 1 in their order.
  static std::vector<std::pair<std::string, std::int64_t>> items_of(const xml::Element& type) {
    std::vector<std::pair<std::string, std::int64_t>> items;
    for (const xml::Element& item : type.children("Item")) {
      items.emplace_back(item.required("name"), static_cast<std::int64_t>(items.size()) + 1);
    }
    return items;
  }

  void add_output(const xml::Element& element) {
    const auto place = places_.find(element.attribute_or("name"));
    if (place == places_.end()) return;
    if (unit_.variables[place->second].causality != Causality::Output) return;
    core::Unknown output{place->second, {}};
    if (const auto dependencies = element.child("DirectDependency")) {
      output.dependencies.emplace();
      for (const xml::Element& name : dependencies->children("Name")) {
        const auto known = places_.find(name.text());
        if (known != places_.end()) output.dependencies->push_back(known->second);
      }
    }
    unit_.outputs.push_back(output);
    unit_.initial_unknowns.push_back(output);
  }

  core::UnitDescription& unit_;
  Fmi1Attributes attributes_;
  TypeDefinitions types_;
  VariableNames names_;
  std::map<std::string, core::ValueReference> places_;
};

}  // namespace

Fmi1Attributes read_fmi1_description(const xml::Element& root, core::UnitDescription& unit) {
  unit.instantiation_token = root.given("guid");
  unit.model_identifier = read_model_identifier(root);
  const bool can_reject_steps = read_fmi1_capabilities(find_stand_alone(root, unit.warnings), unit);
  Fmi1Attributes attributes = Fmi1Variables(root, unit).attributes();
  mark_aliases(attributes.references, unit.variables);
  attributes.can_reject_steps = can_reject_steps;
  return attributes;
}

}  // namespace stride::importer
