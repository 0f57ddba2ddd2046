#include "master/model/unit_of_measure.h"

#include <cmath>

#include <fmt/format.h>

#include "master/util/xml/element.h"

namespace stride::core {
namespace {

/// In the precision of its decimals, so that 0.001 and 1e-6 differ by a factor of 1000.
long double finite_number(const xml::Element& element, const char* attribute, double otherwise) {
  const long double number = element.number<long double>(attribute).value_or(otherwise);
  if (std::isfinite(static_cast<double>(number))) return number;
  element.fail(fmt::format("{}=\"{}\" of {}: expected a finite number", attribute,
                           *element.attribute(attribute), element.tag()));
}

}  // namespace

bool is_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b) {
  const auto number = [](long double value) { return static_cast<double>(value); };
  return a.exponents == b.exponents && number(a.factor) == number(b.factor) &&
         number(a.offset) == number(b.offset);
}

BaseUnitOfMeasure read_base_unit(const xml::Element& element) {
  BaseUnitOfMeasure unit;
  for (std::size_t i = 0; i < kUnitOfMeasureBases.size(); ++i) {
    unit.exponents[i] = element.number<int>(kUnitOfMeasureBases[i]).value_or(0);
  }
  unit.factor = finite_number(element, "factor", 1);
  unit.offset = finite_number(element, "offset", 0);
  if (static_cast<double>(unit.factor) == 0) {
    element.fail(fmt::format("factor=\"0\" of {}: a unit cannot be zero", element.tag()));
  }
  return unit;
}

std::optional<BaseUnitOfMeasure> meaning_of(const UnitOfMeasure& unit) {
  return unit.meaning ? unit.meaning : find_unit_of_measure(unit.name);
}

std::optional<LinearConversion> convert(const UnitOfMeasure& from, const UnitOfMeasure& to) {
  if (from.name.empty() || to.name.empty()) return LinearConversion{};
  const bool is_same = plain_unit_of_measure(from.name) == plain_unit_of_measure(to.name);
  if (is_same && !(from.meaning && to.meaning)) return LinearConversion{};
  const auto a = meaning_of(from);
  const auto b = meaning_of(to);
  if (!a || !b || a->exponents != b->exponents) return std::nullopt;
  return LinearConversion{static_cast<double>(a->factor / b->factor),
                          static_cast<double>((a->offset - b->offset) / b->factor)};
}

}  // namespace stride::core
