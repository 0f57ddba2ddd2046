#include "master/engine/model/unit_of_measure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/base/text/words.h"
#include "master/base/xml/element.h"

namespace stride::core {
namespace {

/// In the precision of its decimals, so that 0.001 and 1e-6 differ by a factor of 1000.
long double finite_number(const xml::Element& element, const char* attribute, double otherwise) {
  const long double number = element.number<long double>(attribute).value_or(otherwise);
  if (std::isfinite(static_cast<double>(number))) return number;
  element.fail(fmt::format("{}=\"{}\" of {}: expected a finite number", attribute,
                           *element.attribute(attribute), element.tag()));
}

/// "0.5" for "0,5"; empty for other texts.
std::string with_decimal_point(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return "";
  text[comma] = '.';
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() ? text : "";
}

bool begins_as_symbol(const std::string& name) {
  const auto first = static_cast<unsigned char>(name.front());
  return std::isalpha(first) != 0 || first >= 0x80 || first == '%' || first == '[';
}

}  // namespace

bool is_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b) {
  const auto number = [](long double value) { return static_cast<double>(value); };
  return a.exponents == b.exponents && number(a.factor) == number(b.factor) &&
         number(a.offset) == number(b.offset);
}

bool is_nearly_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b) {
  constexpr long double kRounding = 1e-6L;
  const auto is_near = [](long double one, long double other) {
    return std::abs(one - other) <= kRounding * std::max(std::abs(one), std::abs(other));
  };
  return a.exponents == b.exponents && is_near(a.factor, b.factor) && is_near(a.offset, b.offset);
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

std::optional<BaseUnitOfMeasure> find_defined(const UnitsOfMeasure& units,
                                              const std::string& name) {
  if (const auto found = units.find(name); found != units.end()) return found->second;
  if (units.empty() || find_unit_of_measure(name)) return std::nullopt;
  return find_unit_of_measure(name, units);
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

std::vector<std::string> known_unit_names() {
  std::vector<std::string> names{"km/h", "m/s", "rad/s", "deg/s", "N.m", "kg/m3", "1"};
  for (const UnitOfMeasureSymbol& known : kUnitOfMeasureSymbols) names.emplace_back(known.symbol);
  for (const UnitOfMeasureSymbol& known : kUnitOfMeasureSymbols) {
    if (!known.takes_prefix) continue;
    for (const char* const prefix : {"k", "M", "m", "u", "c"}) {
      names.push_back(prefix + std::string(known.symbol));
    }
  }
  return names;
}

std::vector<std::string> convertible_names(const UnitOfMeasure& unit) {
  if (unit.name.empty()) return {};
  std::vector<std::string> names{unit.name};
  const auto meaning = meaning_of(unit);
  if (!meaning) return names;
  for (std::string& name : known_unit_names()) {
    const auto known = find_unit_of_measure(name);
    const bool is_other = known && known->exponents == meaning->exponents && name != unit.name;
    if (is_other) names.push_back(std::move(name));
  }
  return names;
}

std::string undefined_text(const UnitOfMeasure& unit) {
  return unit.name.empty() || meaning_of(unit)
             ? ""
             : fmt::format("; nothing defines '{}', and it is not known by name", unit.name);
}

std::string number_with_unit_hint(const std::string& text, const UnitOfMeasure& unit,
                                  bool is_difference) {
  if (const std::string meant = with_decimal_point(text); !meant.empty()) {
    return fmt::format("numbers have a decimal point: {}", meant);
  }
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string name = words_of(end).size() == 1 ? words_of(end).front() : "";
  if (end == text.c_str() || name.empty() || !begins_as_symbol(name)) return "";
  if (unit.name.empty()) return "write the number alone: the variable has no unit of measure";
  const UnitOfMeasure given{name, std::nullopt};
  const std::string in =
      fmt::format("the value is a number in '{}', the variable's unit of measure", unit.name);
  const std::string undefined = undefined_text(given);
  if (!undefined.empty()) {
    return in + undefined + "; " + suggestion(name, convertible_names(unit));
  }
  const auto conversion = convert(given, unit);
  if (!conversion) return fmt::format("{}, and '{}' cannot be converted into it", in, name);
  const double offset = is_difference ? 0 : conversion->offset;
  return fmt::format("{}: {:.10g}", in, conversion->factor * number + offset);
}

}  // namespace stride::core
