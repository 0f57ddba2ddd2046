#include "master/system/ssp/definitions.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/system/ssp/ssp.h"
#include "master/system/ssp/unique_names.h"

namespace stride::ssp {
namespace {

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

core::EnumerationItems read_items(const xml::Element& enumeration,
                                  std::vector<std::string>& warnings) {
  core::EnumerationItems items;
  UniqueNames names("items", warnings);
  for (const xml::Element& item : enumeration.children({kSsc, "Item"})) {
    item.allow_attributes({"name", "value"});
    const std::string name = item.required("name");
    const auto number = item.required_number<std::int64_t>("value");
    const auto is_first = [&](const auto& other) { return other.first == name; };
    const auto first = std::ranges::find_if(items, is_first);
    if (names.add(item, name, [&] { return first->second == number; })) {
      items.emplace_back(name, number);
    }
  }
  return items;
}

void read_unit(const xml::Element& unit, UniqueNames& names, Definitions& definitions,
               std::vector<std::string>& warnings) {
  unit.allow_attributes({"name"});
  for (const xml::Element& child : unit.children()) {
    if (!is_common(child, "BaseUnit", warnings)) {
      if (child.local_name() == "Annotations") continue;
      warn(child, fmt::format("{} is not known in {} and is ignored", child.tag(), unit.tag()),
           warnings);
      continue;
    }
    const std::string name = unit.required("name");
    child.allow_attributes(core::kBaseUnitAttributes);
    const core::BaseUnitOfMeasure base = core::read_base_unit(child);
    auto& units = definitions.units_of_measure;
    if (names.add(unit, name, [&] { return core::is_same(units.at(name), base); })) {
      units.emplace(name, base);
    }
  }
}

void read_enumeration(const xml::Element& enumeration, UniqueNames& names, Definitions& definitions,
                      std::vector<std::string>& warnings) {
  enumeration.allow_attributes({"name"});
  const std::string name = enumeration.required("name");
  core::EnumerationItems items = read_items(enumeration, warnings);
  auto& enumerations = definitions.enumerations;
  if (names.add(enumeration, name, [&] { return enumerations.at(name) == items; })) {
    enumerations.emplace(name, std::move(items));
  }
}

}  // namespace

core::UnitOfMeasure Definitions::unit(const std::string& name) const {
  return {name, core::find_defined(units_of_measure, name)};
}

core::UnitOfMeasure Definitions::unit(const std::string& name, const Definitions& otherwise) const {
  return core::find_defined(units_of_measure, name) ? unit(name) : otherwise.unit(name);
}

Definitions read_definitions(const xml::Element& root, const char* name_space,
                             std::vector<std::string>& warnings) {
  Definitions definitions;
  if (const auto units = root.child({name_space, "Units"})) {
    UniqueNames names("units of measure", warnings);
    for (const xml::Element& unit : units->children()) {
      if (is_common(unit, "Unit", warnings)) {
        read_unit(unit, names, definitions, warnings);
      } else {
        warn(unit, fmt::format("{} is not known in {} and is ignored", unit.tag(), units->tag()),
             warnings);
      }
    }
  }
  if (const auto enumerations = root.child({name_space, "Enumerations"})) {
    UniqueNames names("enumerations", warnings);
    for (const xml::Element& enumeration : enumerations->children({kSsc, "Enumeration"})) {
      read_enumeration(enumeration, names, definitions, warnings);
    }
  }
  return definitions;
}

}  // namespace stride::ssp
