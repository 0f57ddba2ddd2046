#include "master/ssp/definitions.h"

#include <cstdint>

#include <fmt/format.h>

#include "master/ssp/ssp.h"

namespace stride::io {
namespace {

core::BaseUnitOfMeasure read_base_unit(const xml::Element& element) {
  core::BaseUnitOfMeasure unit;
  for (std::size_t i = 0; i < kBaseUnits.size(); ++i) {
    unit.exponents[i] = element.number<int>(kBaseUnits[i]).value_or(0);
  }
  unit.factor = element.number<double>("factor").value_or(1);
  unit.offset = element.number<double>("offset").value_or(0);
  if (unit.factor == 0) element.fail("a unit with the factor 0 measures nothing");
  return unit;
}

core::EnumerationItems read_items(const xml::Element& enumeration) {
  core::EnumerationItems items;
  for (const xml::Element& item : enumeration.children({kSsc, "Item"})) {
    items.emplace_back(item.required("name"), item.required_number<std::int64_t>("value"));
  }
  return items;
}

}  // namespace

core::UnitOfMeasure Definitions::unit(const std::string& name) const {
  const auto found = units.find(name);
  return {name, found == units.end() ? std::nullopt : std::optional(found->second)};
}

core::UnitOfMeasure Definitions::unit(const std::string& name, const Definitions& otherwise) const {
  return units.contains(name) ? unit(name) : otherwise.unit(name);
}

Definitions read_definitions(const xml::Element& root, const char* name_space) {
  Definitions definitions;
  if (const auto units = root.child({name_space, "Units"})) {
    for (const xml::Element& unit : units->children({kSsc, "Unit"})) {
      const auto base = unit.child({kSsc, "BaseUnit"});
      if (base) definitions.units.emplace(unit.required("name"), read_base_unit(*base));
    }
  }
  if (const auto enumerations = root.child({name_space, "Enumerations"})) {
    for (const xml::Element& enumeration : enumerations->children({kSsc, "Enumeration"})) {
      definitions.enumerations.emplace(enumeration.required("name"), read_items(enumeration));
    }
  }
  return definitions;
}

}  // namespace stride::io
