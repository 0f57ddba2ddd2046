#include "master/loader/fmu/description/variable_attributes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ranges>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/lower_case.h"
#include "master/engine/model/finite.h"
#include "master/engine/model/item_text.h"
#include "master/engine/model/meant_value.h"
#include "master/engine/model/values.h"

namespace stride::importer {
namespace {

using core::Causality;
using core::Initial;
using core::ValueType;
using core::Variability;

template <class Enum>
Enum read_enumerator(const xml::Element& element, const char* attribute, Enum otherwise,
                     std::size_t count, std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(core::name(static_cast<Enum>(i)));
  const auto word = element.lenient_word(attribute, names, warnings);
  return word ? find_named<Enum>(*word, count).value_or(otherwise) : otherwise;
}

Variability default_variability(ValueType type, Causality causality) {
  switch (causality) {
    case Causality::Parameter:
    case Causality::CalculatedParameter:
    case Causality::StructuralParameter:
      return Variability::Fixed;
    default:
      break;
  }
  return core::is_real(type) ? Variability::Continuous : Variability::Discrete;
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

/// Units declare parameters that need not be given as NaN.
bool is_unset_parameter(const std::string& text, const core::Variable& variable) {
  return variable.causality == core::Causality::Parameter && core::lower_case(text) == "nan";
}

/// What is odd about an element of a start value, which the unit has by itself; empty: nothing.
std::string oddity_of(const std::string& text, const core::ValueBlock& element,
                      const core::Variable& variable) {
  if (const auto odd = core::not_finite(element); odd && !is_unset_parameter(*odd, variable)) {
    return "is not a finite number";
  }
  if (const auto lost = core::lost_number(text, element)) return "is lost: " + *lost;
  if (variable.type != ValueType::Enumeration || variable.items.empty()) return "";
  const std::int64_t number = element.numbers<std::int64_t>()[0];
  const auto items = variable.items | std::views::values;
  if (std::ranges::find(items, number) != items.end()) return "";
  return "is not an item of its Enumeration: " + core::item_text(variable.items);
}

}  // namespace

std::optional<std::size_t> VariableNames::add(const std::string& name, const xml::Element& place,
                                              const IsSame& is_same) {
  const auto [entry, is_new] =
      first_.try_emplace(name, First{unit_.variables.size(), place.where().line});
  if (is_new) return std::nullopt;
  const auto& [first, line] = entry->second;
  const bool is_ambiguous = !is_same(first);
  if (is_ambiguous) unit_.ambiguous_names.insert(name);
  unit_.warnings.push_back(
      core::to_text({.where = place.where()}) +
      fmt::format("the variable name '{}' is used twice, first in line {}: {}", name, line,
                  is_ambiguous ? "the first one counts, and none can be connected, set or "
                                 "recorded by this name"
                               : "they are the same"));
  return first;
}

bool are_declared_alike(const core::Variable& a, const core::Variable& b) {
  return a.type == b.type && a.causality == b.causality && a.variability == b.variability &&
         a.unit == b.unit && a.is_relative == b.is_relative;
}

void mark_aliases(std::span<const std::uint32_t> references,
                  std::vector<core::Variable>& variables) {
  std::map<std::pair<core::ValueType, std::uint32_t>, core::ValueReference> first;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    core::Variable& variable = variables[i];
    const bool is_integer = variable.type == core::ValueType::Enumeration;
    const core::ValueType base = is_integer ? core::ValueType::Int32 : variable.type;
    const auto [owner, is_new] = first.emplace(std::pair(base, references[i]), variable.reference);
    if (!is_new) variable.shares_value_of = owner->second;
  }
}

void TypeDefinitions::add(const xml::Element& definition, const xml::Element& type) {
  const std::string name = definition.required("name");
  if (types_.emplace(name, type).second) return;
  definition.fail(fmt::format("the type '{}' is defined twice", name));
}

std::optional<xml::Element> TypeDefinitions::declared(const xml::Element& element) const {
  const auto name = element.attribute("declaredType");
  if (!name) return std::nullopt;
  if (const auto found = types_.find(*name); found != types_.end()) return found->second;
  if (missing_.insert(*name).second) {
    warnings_->push_back(core::to_text({.where = element.where()}) +
                         fmt::format("declaredType=\"{}\" is ignored: there is no such type in "
                                     "<TypeDefinitions>",
                                     *name));
  }
  return std::nullopt;
}

void TypeDefinitions::fail_without(const xml::Element& enumeration) {
  enumeration.fail(fmt::format("declaredType=\"{}\": there is no such type in <TypeDefinitions>",
                               enumeration.required("declaredType")));
}

core::Causality read_causality(const xml::Element& variable, std::vector<std::string>& warnings) {
  return read_enumerator(variable, "causality", Causality::Local, 7, warnings);
}

core::Variability read_variability(const xml::Element& variable, core::ValueType type,
                                   core::Causality causality, std::vector<std::string>& warnings) {
  return read_enumerator(variable, "variability", default_variability(type, causality), 5,
                         warnings);
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

std::string inherited(const xml::Element& element, const std::optional<xml::Element>& type,
                      const char* attribute) {
  return element.attribute_or(attribute, type ? type->attribute_or(attribute) : "");
}

void read_unit(const xml::Element& element, const std::optional<xml::Element>& declared,
               core::Variable& variable, std::vector<std::string>& warnings) {
  const char* const relative = "relativeQuantity";
  variable.unit = inherited(element, declared, "unit");
  const bool is_own = element.attribute(relative) || !declared;
  variable.is_relative = (is_own ? element : *declared).lenient_flag(relative, warnings);
}

double read_nominal(const xml::Element& element, ValueType type,
                    const std::optional<xml::Element>& declared) {
  if (!core::is_real(type)) return 0;
  const auto own = element.number<double>("nominal");
  const auto nominal = own || !declared ? own : declared->number<double>("nominal");
  return std::isfinite(nominal.value_or(0)) ? std::abs(nominal.value_or(0)) : 0;
}

void check_start(const xml::Element& element, core::Variable& variable,
                 std::vector<std::string>& warnings, std::size_t elements) {
  const bool is_text = variable.type == ValueType::String || variable.type == ValueType::Binary;
  const std::size_t count = is_text ? elements : xml::split(variable.start).size();
  if (!is_text && count == 0 && variable.size > 0 && element.attribute("start")) {
    warnings.push_back(core::to_text({.where = element.where()}) +
                       fmt::format("start=\"{}\" of '{}' has no value, and is ignored",
                                   variable.start, variable.name));
    variable.start.clear();
  }
  if (variable.start.empty() || variable.type == ValueType::Clock) return;
  if (count != 1 && count != variable.size) {
    element.fail(fmt::format("the start value of '{}' has {} elements, the variable has {}",
                             variable.name, count, variable.size),
                 "give one value for each element, separated by blanks");
  }
  if (variable.type == ValueType::String) return;
  if (auto meant = core::meant_value(variable.type, variable.start)) {
    warnings.push_back(
        core::to_text({.where = element.where()}) +
        fmt::format("start=\"{}\" of '{}' is taken for {}", variable.start, variable.name, *meant));
    variable.start = std::move(*meant);
  }
  core::Variable form;  // what an element has to be
  form.type = variable.type == ValueType::Enumeration ? ValueType::Int64 : variable.type;
  try {
    for (const std::string_view word : xml::split(variable.start)) {
      const std::string text(word);
      const std::string odd = oddity_of(text, core::parse(form, text), variable);
      if (odd.empty()) continue;
      warnings.push_back(core::to_text({.where = element.where()}) +
                         fmt::format("start=\"{}\" of '{}' {}", word, variable.name, odd));
      break;
    }
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("the start value of '{}': {}", variable.name, mistake.what()));
  }
}

void check_limits(const xml::Element& element, core::Variable& variable,
                  std::vector<std::string>& warnings) {
  const auto read = [&](const char* attribute, const std::string& text) -> std::optional<double> {
    if (text.empty()) return std::nullopt;
    const auto words = xml::split(text);
    const auto number = words.size() == 1 ? xml::to_number<double>(words.front()) : std::nullopt;
    if (number && !std::isnan(*number)) return number;
    element.fail(
        fmt::format("{}=\"{}\" of '{}': expected a number", attribute, text, variable.name));
  };
  const auto least = read("min", variable.min);
  const auto greatest = read("max", variable.max);
  if (!least || !greatest || *least <= *greatest) return;
  warnings.push_back(core::to_text({.where = element.where()}) +
                     fmt::format("min=\"{}\" of '{}' is above max=\"{}\"; both are ignored",
                                 variable.min, variable.name, variable.max));
  variable.min.clear();
  variable.max.clear();
}

std::vector<std::pair<std::string, std::int64_t>> read_items(const xml::Element& type) {
  std::vector<std::pair<std::string, std::int64_t>> items;
  for (const xml::Element& item : type.children("Item")) {
    items.emplace_back(item.given("name"), item.required_number<std::int64_t>("value"));
  }
  return items;
}

}  // namespace stride::importer
