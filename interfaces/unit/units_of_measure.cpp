#include "interfaces/unit/units_of_measure.h"

#include <cmath>
#include <set>
#include <stdexcept>

namespace stride::kit {
namespace {

[[noreturn]] void reject(const UnitOfMeasureDefinition& definition, const std::string& mistake) {
  throw std::logic_error("unit of measure '" + definition.name + "': " + mistake);
}

}  // namespace

void check_units_of_measure(const Unit& unit) {
  std::set<std::string> names;
  for (const UnitOfMeasureDefinition& definition : unit.units_of_measure()) {
    if (definition.name.empty()) reject(definition, "it has no name");
    if (!names.insert(definition.name).second) reject(definition, "it is defined twice");
    if (!std::isfinite(definition.factor) || definition.factor == 0) {
      reject(definition, "expected a finite factor other than 0");
    }
    if (!std::isfinite(definition.offset)) reject(definition, "expected a finite offset");
    if (find_unit_of_measure(definition.in)) continue;
    reject(definition, "'" + definition.in +
                           "', by which it is defined, is not known; expected an expression such "
                           "as \"m\", \"kg/m3\" or \"W/(m2.K)\"");
  }
}

OwnUnitsOfMeasure own_units_of_measure(const Unit& unit) {
  OwnUnitsOfMeasure own;
  for (const UnitOfMeasureDefinition& definition : unit.units_of_measure()) {
    BaseUnitOfMeasure base = find_unit_of_measure(definition.in).value();
    base.offset += base.factor * static_cast<long double>(definition.offset);
    base.factor *= static_cast<long double>(definition.factor);
    own.emplace(definition.name, base);
  }
  return own;
}

}  // namespace stride::kit
