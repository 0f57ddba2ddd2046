#include "master/fmi/model_variables.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/fmi/clock_attributes.h"

namespace stride::fmi {
namespace {

using core::Causality;
using core::Initial;
using core::ValueType;
using core::Variability;

using TypeDefinitions = std::map<std::string, xml::Element>;

/// The enumerator of this name, of the first `count`.
template <class Enum>
std::optional<Enum> find_named(std::string_view word, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (word == core::name(static_cast<Enum>(i))) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

template <class Enum>
Enum read_word(const xml::Element& element, const char* attribute, Enum otherwise,
               std::size_t count) {
  const auto word = element.attribute(attribute);
  if (!word) return otherwise;
  if (const auto found = find_named<Enum>(*word, count)) return *found;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(core::name(static_cast<Enum>(i)));
  element.fail(fmt::format("{}=\"{}\" of {}: expected one of {}", attribute, *word, element.tag(),
                           fmt::join(names, ", ")));
}

/// FMI 3.0, 2.4.7.4: the default of the attribute `variability`.
Variability default_variability(ValueType type, Causality causality) {
  switch (causality) {
    case Causality::Parameter:
    case Causality::CalculatedParameter:
    case Causality::StructuralParameter:
      return Variability::Fixed;
    default:
      break;
  }
  const bool is_float = type == ValueType::Float32 || type == ValueType::Float64;
  return is_float ? Variability::Continuous : Variability::Discrete;
}

/// FMI 3.0, 2.4.7.5, the table that defines `initial`: what it may be, its default first. Nothing
/// for what cannot have the attribute.
std::vector<Initial> possible_initials(const core::Variable& variable) {
  if (variable.type == ValueType::Clock) return {};
  switch (variable.causality) {
    case Causality::Independent:
      return {};
    case Causality::Parameter:
    case Causality::StructuralParameter:
    case Causality::Input:
      return {Initial::Exact};
    default:
      break;
  }
  switch (variable.variability) {
    case Variability::Constant:
      return {Initial::Exact};
    case Variability::Fixed:
    case Variability::Tunable:
      return {Initial::Calculated, Initial::Approx};
    default:
      return {Initial::Calculated, Initial::Exact, Initial::Approx};
  }
}

Initial read_initial(const xml::Element& element, const core::Variable& variable) {
  const std::vector<Initial> possible = possible_initials(variable);
  const auto word = element.attribute("initial");
  if (!word) return possible.empty() ? Initial::None : possible.front();
  for (const Initial initial : possible) {
    if (*word == core::name(initial)) return initial;
  }
  std::vector<std::string> names;
  for (const Initial initial : possible) names.emplace_back(core::name(initial));
  element.fail(fmt::format("initial=\"{}\" of the {} {} '{}': expected {}", *word,
                           core::name(variable.variability), core::name(variable.causality),
                           variable.name,
                           names.empty() ? "none" : fmt::format("{}", fmt::join(names, " or "))));
}

TypeDefinitions read_type_definitions(const xml::Element& root) {
  TypeDefinitions types;
  const auto definitions = root.child("TypeDefinitions");
  if (!definitions) return types;
  for (const xml::Element& definition : definitions->children()) {
    if (definition.is("", "Annotations")) continue;
    const std::string name = definition.required("name");
    if (!types.emplace(name, definition).second) {
      definition.fail(fmt::format("the type '{}' is defined twice", name));
    }
  }
  return types;
}

std::optional<xml::Element> declared_type(const xml::Element& element,
                                          const TypeDefinitions& types) {
  const auto name = element.attribute("declaredType");
  if (!name) return std::nullopt;
  const auto found = types.find(*name);
  if (found == types.end()) {
    element.fail(
        fmt::format("declaredType=\"{}\": there is no such type in <TypeDefinitions>", *name));
  }
  if (found->second.name().local != fmt::format("{}Type", element.name().local)) {
    element.fail(fmt::format("declaredType=\"{}\" is a {}; expected a <{}Type>", *name,
                             found->second.tag(), element.name().local));
  }
  return found->second;
}

/// A String or Binary variable has an element per start value, the other types an attribute.
std::string read_start(const xml::Element& element, ValueType type) {
  if (type != ValueType::String && type != ValueType::Binary) return element.attribute_or("start");
  std::vector<std::string> values;
  for (const xml::Element& start : element.children("Start"))
    values.push_back(start.attribute_or("value"));
  return fmt::format("{}", fmt::join(values, " "));
}

/// An attribute of the variable, or else of its declared type.
std::string inherited(const xml::Element& element, const std::optional<xml::Element>& type,
                      const char* attribute) {
  return element.attribute_or(attribute, type ? type->attribute_or(attribute) : "");
}

double read_nominal(const xml::Element& element, ValueType type,
                    const std::optional<xml::Element>& declared) {
  if (type != ValueType::Float32 && type != ValueType::Float64) return 0;
  const auto own = element.number<double>("nominal");
  const auto nominal = own || !declared ? own : declared->number<double>("nominal");
  return std::isfinite(nominal.value_or(0)) ? std::abs(nominal.value_or(0)) : 0;
}

core::Variable read_variable(const xml::Element& element, ValueType type,
                             const TypeDefinitions& types) {
  core::Variable variable;
  variable.name = element.required("name");
  variable.reference = element.required_number<core::ValueReference>("valueReference");
  variable.type = type;
  variable.causality = read_word(element, "causality", Causality::Local, 7);
  variable.variability =
      read_word(element, "variability", default_variability(type, variable.causality), 5);
  variable.initial = read_initial(element, variable);
  variable.description = element.attribute_or("description");
  for (const xml::Element& alias : element.children("Alias")) {
    variable.aliases.push_back(alias.required("name"));
  }
  variable.start = read_start(element, type);
  variable.clocks = element.number_list<core::ValueReference>("clocks");
  // a clocked variable is discrete (FMI 3.0, 2.2.8.3), whatever the default for its type
  const bool continuous = variable.variability == Variability::Continuous;
  if (variable.is_clocked() && continuous) variable.variability = Variability::Discrete;
  const auto declared = declared_type(element, types);
  variable.unit = inherited(element, declared, "unit");
  variable.min = inherited(element, declared, "min");
  variable.max = inherited(element, declared, "max");
  variable.nominal = read_nominal(element, type, declared);
  if (type == ValueType::Clock) {
    variable.clock = read_clock_attributes(element, declared, variable.causality);
  }
  variable.intermediate_update = element.flag("intermediateUpdate");
  if (type != ValueType::Enumeration) return variable;
  if (!declared) element.required("declaredType");
  for (const xml::Element& item : declared->children("Item")) {
    variable.items.emplace_back(item.given("name"), item.required_number<std::int64_t>("value"));
  }
  return variable;
}

/// Finds what stands between single variables: names, references, clocks, dimensions.
class Linker {
 public:
  Linker(std::vector<core::Variable>& variables, const std::vector<xml::Element>& elements)
      : variables_(variables), elements_(elements) {}

  VariableIndex run() {
    for (std::size_t i = 0; i < variables_.size(); ++i) add(i);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      check_clocks(i);
      read_dimensions(i);
    }
    return std::move(index_);
  }

 private:
  void add(std::size_t i) {
    const core::Variable& variable = variables_[i];
    add_name(variable.name, elements_[i]);
    for (const xml::Element& alias : elements_[i].children("Alias")) {
      add_name(alias.required("name"), alias);
    }
    const auto [same_reference, is_new] = index_.emplace(variable.reference, i);
    if (is_new) return;
    elements_[i].fail(fmt::format(
        "variable '{}' has the value reference {} of '{}' in line {}", variable.name,
        variable.reference, variables_[same_reference->second].name, line(same_reference->second)));
  }

  void add_name(const std::string& name, const xml::Element& place) {
    const auto [same, is_new] = names_.emplace(name, place.where().line);
    if (is_new) return;
    place.fail(
        fmt::format("the variable name '{}' is used twice, first in line {}", name, same->second));
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
  const std::vector<xml::Element>& elements_;
  std::map<std::string, int> names_;  ///< and aliases, with their lines
  VariableIndex index_;
};

}  // namespace

VariableIndex read_variables(const xml::Element& root, std::vector<core::Variable>& variables) {
  const auto list = root.child("ModelVariables");
  if (!list) root.fail("<ModelVariables> is missing");
  const TypeDefinitions types = read_type_definitions(root);
  std::vector<xml::Element> elements;
  for (const xml::Element& element : list->children()) {
    if (element.is("", "Annotations")) continue;
    const auto type = find_named<ValueType>(element.name().local, core::kValueTypeCount);
    if (!type) element.fail(fmt::format("{} is no type of FMI 3.0", element.tag()));
    variables.push_back(read_variable(element, *type, types));
    elements.push_back(element);
  }
  return Linker(variables, elements).run();
}

}  // namespace stride::fmi
