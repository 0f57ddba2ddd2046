#include "master/ssp/definitions.h"

#include <cstdint>

#include <fmt/format.h>

#include "master/ssp/ssp.h"

namespace stride::ssp {
namespace {

core::EnumerationItems read_items(const xml::Element& enumeration) {
  core::EnumerationItems items;
  for (const xml::Element& item : enumeration.children({kSsc, "Item"})) {
    items.emplace_back(item.required("name"), item.required_number<std::int64_t>("value"));
  }
  return items;
}

}  // namespace

core::UnitOfMeasure Definitions::unit(const std::string& name) const {
  const auto found = units_of_measure.find(name);
  return {name, found == units_of_measure.end() ? std::nullopt : std::optional(found->second)};
}

core::UnitOfMeasure Definitions::unit(const std::string& name, const Definitions& otherwise) const {
  return units_of_measure.contains(name) ? unit(name) : otherwise.unit(name);
}

Definitions read_definitions(const xml::Element& root, const char* name_space) {
  Definitions definitions;
  if (const auto units = root.child({name_space, "Units"})) {
    for (const xml::Element& unit : units->children({kSsc, "Unit"})) {
      const auto base = unit.child({kSsc, "BaseUnit"});
      if (base)
        definitions.units_of_measure.emplace(unit.required("name"), core::read_base_unit(*base));
    }
  }
  if (const auto enumerations = root.child({name_space, "Enumerations"})) {
    for (const xml::Element& enumeration : enumerations->children({kSsc, "Enumeration"})) {
      definitions.enumerations.emplace(enumeration.required("name"), read_items(enumeration));
    }
  }
  return definitions;
}

}  // namespace stride::ssp
