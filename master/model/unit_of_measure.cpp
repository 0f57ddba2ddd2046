#include "master/model/unit_of_measure.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "master/util/xml/element.h"

namespace stride::core {
namespace {

double finite_number(const xml::Element& element, const char* attribute, double otherwise) {
  const double number = element.number<double>(attribute).value_or(otherwise);
  if (std::isfinite(number)) return number;
  element.fail(fmt::format("{}=\"{}\" of {}: expected a finite number", attribute,
                           *element.attribute(attribute), element.tag()));
}

/// Some tools write [m] for m.
std::string_view without_brackets(std::string_view name) {
  const bool has_brackets = name.starts_with('[') && name.ends_with(']');
  return has_brackets ? name.substr(1, name.size() - 2) : name;
}

}  // namespace

BaseUnitOfMeasure read_base_unit(const xml::Element& element) {
  BaseUnitOfMeasure unit;
  for (std::size_t i = 0; i < kBaseUnits.size(); ++i) {
    unit.exponents[i] = element.number<int>(kBaseUnits[i]).value_or(0);
  }
  unit.factor = finite_number(element, "factor", 1);
  unit.offset = finite_number(element, "offset", 0);
  if (unit.factor == 0) {
    element.fail(fmt::format("factor=\"0\" of {}: a unit cannot be zero", element.tag()));
  }
  return unit;
}

std::optional<LinearConversion> convert(const UnitOfMeasure& from, const UnitOfMeasure& to) {
  if (from.name.empty() || to.name.empty()) return LinearConversion{};
  if (!from.meaning || !to.meaning) {
    const bool is_same = without_brackets(from.name) == without_brackets(to.name);
    return is_same ? std::optional(LinearConversion{}) : std::nullopt;
  }
  const BaseUnitOfMeasure& a = *from.meaning;
  const BaseUnitOfMeasure& b = *to.meaning;
  if (a.exponents != b.exponents) return std::nullopt;
  return LinearConversion{a.factor / b.factor, (a.offset - b.offset) / b.factor};
}

}  // namespace stride::core
