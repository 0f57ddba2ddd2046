#include "master/ssp/definitions.h"

#include <cstdint>
#include <string_view>

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

void warn(const xml::Element& element, const std::string& message,
          std::vector<std::string>& warnings) {
  warnings.push_back(core::to_text({.where = element.where()}) + message);
}

/// Whether it is <ssc:NAME>, or meant to be.
bool is_common(const xml::Element& element, std::string_view name,
               std::vector<std::string>& warnings) {
  if (element.local_name() != name) return false;
  if (element.name().name_space == kSsc) return true;
  warn(element,
       fmt::format("{} is taken for <ssc:{}> of the namespace '{}'", element.tag(), name, kSsc),
       warnings);
  return true;
}

void read_unit(const xml::Element& unit, Definitions& definitions,
               std::vector<std::string>& warnings) {
  for (const xml::Element& child : unit.children()) {
    if (!is_common(child, "BaseUnit", warnings)) continue;
    definitions.units_of_measure.emplace(unit.required("name"), core::read_base_unit(child));
  }
}

}  // namespace

core::UnitOfMeasure Definitions::unit(const std::string& name) const {
  const auto found = units_of_measure.find(name);
  return {name, found == units_of_measure.end() ? std::nullopt : std::optional(found->second)};
}

core::UnitOfMeasure Definitions::unit(const std::string& name, const Definitions& otherwise) const {
  return units_of_measure.contains(name) ? unit(name) : otherwise.unit(name);
}

Definitions read_definitions(const xml::Element& root, const char* name_space,
                             std::vector<std::string>& warnings) {
  Definitions definitions;
  if (const auto units = root.child({name_space, "Units"})) {
    for (const xml::Element& unit : units->children()) {
      if (is_common(unit, "Unit", warnings)) {
        read_unit(unit, definitions, warnings);
      } else {
        warn(unit, fmt::format("{} is not known in {} and is ignored", unit.tag(), units->tag()),
             warnings);
      }
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
