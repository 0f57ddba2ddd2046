#include "master/loader/fmu/description/fmi3_description.h"

#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/loader/fmu/description/clock_attributes.h"
#include "master/loader/fmu/description/common_description.h"
#include "master/loader/fmu/description/variable_attributes.h"

namespace stride::importer {
namespace {

using core::Causality;
using core::ValueType;
using core::Variability;

/// Value reference -> index of the variable.
using VariableIndex = std::map<core::ValueReference, std::size_t>;

// ---- Variables, with what their declared types add ----

TypeDefinitions read_type_definitions(const xml::Element& root,
                                      std::vector<std::string>& warnings) {
  TypeDefinitions types(warnings);
  const auto definitions = root.child("TypeDefinitions");
  if (!definitions) return types;
  for (const xml::Element& definition : definitions->children()) {
    if (!definition.is("", "Annotations")) types.add(definition, definition);
  }
  return types;
}

std::optional<xml::Element> declared_type(const xml::Element& element,
                                          const TypeDefinitions& types) {
  const auto type = types.declared(element);
  if (type && type->name().local != fmt::format("{}Type", element.name().local)) {
    element.fail(fmt::format("declaredType=\"{}\" is a {}; expected a <{}Type>",
                             *element.attribute("declaredType"), type->tag(),
                             element.name().local));
  }
  return type;
}

/// A String or Binary variable has an element per start value, the other types an attribute.
std::string read_start(const xml::Element& element, ValueType type) {
  if (type != ValueType::String && type != ValueType::Binary) return element.attribute_or("start");
  std::vector<std::string> values;
  for (const xml::Element& start : element.children("Start"))
    values.push_back(start.attribute_or("value"));
  return fmt::format("{}", fmt::join(values, " "));
}

core::Variable read_variable(const xml::Element& element, ValueType type,
                             const TypeDefinitions& types, std::vector<std::string>& warnings) {
  core::Variable variable;
  variable.name = element.required("name");
  variable.reference = element.required_number<core::ValueReference>("valueReference");
  variable.type = type;
  variable.causality = read_causality(element, warnings);
  variable.variability = read_variability(element, type, variable.causality, warnings);
  variable.initial = read_initial(element, variable);
  variable.description = element.attribute_or("description");
  variable.start = read_start(element, type);
  variable.clocks = element.number_list<core::ValueReference>("clocks");
  // a clocked variable is discrete (FMI 3.0, 2.2.8.3), whatever the default for its type
  const bool continuous = variable.variability == Variability::Continuous;
  if (variable.is_clocked() && continuous) variable.variability = Variability::Discrete;
  const auto declared = declared_type(element, types);
  read_unit(element, declared, variable, warnings);
  variable.min = inherited(element, declared, "min");
  variable.max = inherited(element, declared, "max");
  variable.nominal = read_nominal(element, type, declared);
  if (type == ValueType::Clock) {
    variable.clock = read_clock_attributes(element, declared, variable.causality, warnings);
  }
  variable.intermediate_update = element.lenient_flag("intermediateUpdate", warnings);
  if (type != ValueType::Enumeration) return variable;
  if (!declared) TypeDefinitions::fail_without(element);
  variable.items = read_items(*declared);
  return variable;
}

/// Resolves the relations of variables: names, references, clocks, dimensions.
class Linker {
 public:
  Linker(core::UnitDescription& unit, const std::vector<xml::Element>& elements)
      : variables_(unit.variables), warnings_(unit.warnings), elements_(elements) {}

  VariableIndex run() {
    for (std::size_t i = 0; i < variables_.size(); ++i) add(i);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      check_clocks(i);
      read_dimensions(i);
    }
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      check_start(elements_[i], variables_[i], warnings_, elements_[i].children("Start").size());
      check_limits(elements_[i], variables_[i], warnings_);
    }
    return std::move(index_);
  }

 private:
  void add(std::size_t i) {
    const core::Variable& variable = variables_[i];
    const auto [same_reference, is_new] = index_.emplace(variable.reference, i);
    if (is_new) return;
    elements_[i].fail(fmt::format(
        "variable '{}' has the value reference {} of '{}' in line {}", variable.name,
        variable.reference, variables_[same_reference->second].name, line(same_reference->second)));
  }

  void check_clocks(std::size_t i) const {
    for (const core::ValueReference clock : variables_[i].clocks) {
      const core::Variable* found = find(clock);
      if (found == nullptr) {
        elements_[i].fail(fmt::format("variable '{}' belongs to the clock {}, which does not exist",
                                      variables_[i].name, clock));
      }
      if (found->type == ValueType::Clock) continue;
      elements_[i].fail(
          fmt::format("variable '{}' belongs to the clock {}, but '{}' has the type {}",
                      variables_[i].name, clock, found->name, core::name(found->type)));
    }
  }

  void read_dimensions(std::size_t i) {
    core::Variable& variable = variables_[i];
    for (const xml::Element& dimension : elements_[i].children("Dimension")) {
      variable.dimensions.push_back(read_dimension(dimension));
    }
    const auto size = core::element_count(variable.dimensions);
    if (!size) {
      elements_[i].fail(fmt::format("variable '{}' has more than {} elements", variable.name,
                                    core::kMaxElements));
    }
    variable.size = *size;
  }

  core::Dimension read_dimension(const xml::Element& dimension) const {
    if (const auto fixed = dimension.number<std::uint64_t>("start")) return *fixed;
    const auto reference = dimension.number<core::ValueReference>("valueReference");
    if (!reference) dimension.fail("<Dimension> needs 'start' or 'valueReference'");
    const core::Variable* source = find(*reference);
    const bool gives_size =
        source != nullptr && (source->causality == Causality::StructuralParameter ||
                              source->variability == Variability::Constant);
    if (!gives_size) {
      dimension.fail(
          fmt::format("the value reference {} of <Dimension> is not that of a "
                      "structural parameter",
                      *reference));
    }
    const auto words = xml::split(source->start);
    const auto size = words.size() == 1 ? xml::to_number<std::uint64_t>(words[0]) : std::nullopt;
    if (!size) {
      dimension.fail(
          fmt::format("the structural parameter '{}' has the start value '{}'; "
                      "expected a number of elements",
                      source->name, source->start));
    }
    const bool is_parameter = source->causality == Causality::StructuralParameter;
    return {*size, is_parameter ? reference : std::nullopt};
  }

  const core::Variable* find(core::ValueReference reference) const {
    const auto found = index_.find(reference);
    return found == index_.end() ? nullptr : &variables_[found->second];
  }
  int line(std::size_t i) const { return elements_[i].where().line; }

  std::vector<core::Variable>& variables_;
  std::vector<std::string>& warnings_;
  const std::vector<xml::Element>& elements_;
  VariableIndex index_;
};

/// Its own name and the aliases, of which those that are there already are left out. Returns false
/// if its own is.
bool add_names(const xml::Element& element, core::Variable& variable,
               const core::UnitDescription& unit, VariableNames& names) {
  const auto is_same = [&](std::size_t first) {
    const core::Variable& other = unit.variables[first];
    return other.reference == variable.reference && are_declared_alike(other, variable);
  };
  if (names.add(variable.name, element, is_same)) return false;
  variable.aliases.clear();
  for (const xml::Element& alias : element.children("Alias")) {
    const std::string name = alias.required("name");
    const auto is_own = [&](std::size_t first) { return first == unit.variables.size(); };
    if (!names.add(name, alias, is_own)) variable.aliases.push_back(name);
  }
  return true;
}

/// Appends the variables of <ModelVariables> in order.
VariableIndex read_variables(const xml::Element& root, core::UnitDescription& unit) {
  const auto list = root.child("ModelVariables");
  if (!list) root.fail("<ModelVariables> is missing");
  const TypeDefinitions types = read_type_definitions(root, unit.warnings);
  std::vector<xml::Element> elements;
  VariableNames names(unit);
  for (const xml::Element& element : list->children()) {
    if (element.is("", "Annotations")) continue;
    const auto type = find_named<ValueType>(element.name().local, core::kValueTypeCount);
    if (!type) element.fail(fmt::format("{} is not a type of FMI 3.0", element.tag()));
    core::Variable variable = read_variable(element, *type, types, unit.warnings);
    if (!add_names(element, variable, unit, names)) continue;
    unit.variables.push_back(std::move(variable));
    elements.push_back(element);
  }
  return Linker(unit, elements).run();
}

// ---- Capabilities, dependencies, annotations ----

void read_co_simulation(const xml::Element& element, core::UnitDescription& unit) {
  read_capabilities(element, unit);
  unit.has_event_mode = element.lenient_flag("hasEventMode", unit.warnings);
  unit.can_save_state = element.lenient_flag("canGetAndSetFMUState", unit.warnings);
  unit.can_serialize_state = element.lenient_flag("canSerializeFMUState", unit.warnings);
  unit.may_return_early = element.lenient_flag("mightReturnEarlyFromDoStep", unit.warnings);
  unit.provides_intermediate_update =
      element.lenient_flag("providesIntermediateUpdate", unit.warnings);
  unit.provides_directional_derivatives =
      element.lenient_flag("providesDirectionalDerivatives", unit.warnings);
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
                           place ? "another variable" : "not a variable", core::name(type)));
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
      unit.allows_snapshots = element.flag("allowsSnapshots", unit.allows_snapshots);
      unit.maximum_step = read_step_size(element, "maximumStep");
      unit.verdict = read_output(element, "verdict", core::ValueType::Boolean, unit);
      unit.verdict_text = read_output(element, "verdictText", core::ValueType::String, unit);
    }
  }
}

}  // namespace

void read_fmi3_description(const xml::Element& root, core::UnitDescription& unit) {
  unit.instantiation_token = root.given("instantiationToken");
  read_co_simulation(find_co_simulation(root, unit.warnings), unit);
  const VariableIndex index = read_variables(root, unit);
  const auto reader = [&index](const char* name) {
    return [&index, name](const auto& structure) { return read_unknowns(structure, name, index); };
  };
  read_model_structure(root, unit, reader("Output"), reader("InitialUnknown"));
  read_annotation(root, unit);
}

}  // namespace stride::importer
