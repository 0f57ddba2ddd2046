#include "master/system/declaration/intervention_element.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/system/declaration/parse_attribute.h"

namespace stride::scenario {
namespace {

Time read_time(const xml::Element& element, const char* attribute) {
  return parse_attribute(element, attribute, core::parse_time);
}

InterventionDeclaration read_set(const xml::Element& element) {
  element.allow_attributes({"variable", "value", "at"});
  return {.kind = core::Intervention::Kind::Set,
          .variable = element.required("variable"),
          .value = element.required("value"),
          .from = read_time(element, "at"),
          .where = element.where()};
}

/// What lasts for some time; it has no value yet.
InterventionDeclaration read_lasting(const xml::Element& element, core::Intervention::Kind kind) {
  InterventionDeclaration declared{.kind = kind,
                                   .variable = element.required("variable"),
                                   .from = read_time(element, "from"),
                                   .where = element.where()};
  if (element.attribute("until")) declared.until = read_time(element, "until");
  return declared;
}

/// Without a value the input is held.
InterventionDeclaration read_force(const xml::Element& element) {
  element.allow_attributes({"variable", "value", "from", "until"});
  const auto value = element.attribute("value");
  InterventionDeclaration declared = read_lasting(
      element, value ? core::Intervention::Kind::Force : core::Intervention::Kind::Hold);
  declared.value = value;
  return declared;
}

InterventionDeclaration read_drop(const xml::Element& element) {
  element.allow_attributes({"variable", "from", "until"});
  return read_lasting(element, core::Intervention::Kind::Drop);
}

InterventionDeclaration read_delay(const xml::Element& element) {
  element.allow_attributes({"variable", "time", "from", "until"});
  InterventionDeclaration declared = read_lasting(element, core::Intervention::Kind::Delay);
  declared.value = element.required("time");
  return declared;
}

InterventionDeclaration read_corrupt(const xml::Element& element) {
  element.allow_attributes({"variable", "bits", "header", "seed", "from", "until"});
  InterventionDeclaration declared = read_lasting(element, core::Intervention::Kind::Corrupt);
  declared.value =
      fmt::format("{},{}", element.attribute_or("bits", "1"), element.attribute_or("header", "0"));
  declared.seed = element.number<std::uint64_t>("seed").value_or(declared.seed);
  return declared;
}

}  // namespace

InterventionDeclaration read_intervention(const xml::Element& element) {
  element.allow_children({});
  const std::string_view name = element.local_name();
  if (name == "Set") return read_set(element);
  if (name == "Force") return read_force(element);
  if (name == "Drop") return read_drop(element);
  if (name == "Delay") return read_delay(element);
  if (name == "Corrupt") return read_corrupt(element);
  element.fail(fmt::format("{} is no intervention", element.tag()),
               "those there are: Set, Force, Drop, Delay, Corrupt");
}

}  // namespace stride::scenario
