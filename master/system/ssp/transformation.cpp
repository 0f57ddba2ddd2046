#include "master/system/ssp/transformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/engine/model/transformation.h"
#include "master/system/ssp/ssp.h"

namespace stride::ssp {
namespace {

using core::Transformation;
using TransformationKind = core::Transformation::Kind;

double finite(const xml::Element& element, const char* attribute, double otherwise) {
  const double number = element.number<double>(attribute).value_or(otherwise);
  if (std::isfinite(number)) return number;
  element.fail(fmt::format("{}=\"{}\" is not a finite number", attribute, number));
}

void read_linear(const xml::Element& element, Transformation& transformation) {
  element.allow_attributes({"factor", "offset"});
  transformation.linear = {finite(element, "factor", 1), finite(element, "offset", 0)};
}

/// Refuses a second entry for one source. `sources`: those of the entries so far, as text.
template <class Entries, class Source, class Target>
void add_entry(const xml::Element& element, std::set<std::string>& sources, Entries& entries,
               Source source, Target target) {
  if (!sources.insert(fmt::format("{}", source)).second) {
    element.fail(fmt::format("the source \"{}\" is mapped twice", element.given("source")),
                 "keep one of the two entries");
  }
  entries.emplace_back(std::move(source), std::move(target));
}

/// Which must be there.
bool read_boolean(const xml::Element& entry, const char* attribute,
                  std::vector<std::string>& warnings) {
  entry.given(attribute);
  return entry.lenient_flag(attribute, warnings);
}

void read_entry(const xml::Element& element, std::set<std::string>& sources,
                Transformation& transformation, std::vector<std::string>& warnings) {
  element.allow_attributes({"source", "target"});
  switch (transformation.kind) {
    case TransformationKind::BooleanMapping:
      return add_entry(element, sources, transformation.numbers,
                       std::int64_t{read_boolean(element, "source", warnings)},
                       std::int64_t{read_boolean(element, "target", warnings)});
    case TransformationKind::IntegerMapping:
      return add_entry(element, sources, transformation.numbers,
                       element.required_number<std::int64_t>("source"),
                       element.required_number<std::int64_t>("target"));
    default:
      return add_entry(element, sources, transformation.names, element.given("source"),
                       element.given("target"));
  }
}

void read_mapping(const xml::Element& element, Transformation& transformation,
                  std::vector<std::string>& warnings) {
  element.allow_attributes({});
  element.allow_children({{kSsc, "MapEntry"}});
  std::set<std::string> sources;
  for (const xml::Element& entry : element.children()) {
    read_entry(entry, sources, transformation, warnings);
  }
  std::sort(transformation.numbers.begin(), transformation.numbers.end());
  if (transformation.numbers.empty() && transformation.names.empty()) {
    element.fail(fmt::format("{} holds no <MapEntry>", element.tag()),
                 "write one such as <ssc:MapEntry source=\"…\" target=\"…\"/>");
  }
}

}  // namespace

core::PathSegment read_path_segment(const xml::Element& owner, std::vector<std::string>& warnings) {
  core::PathSegment segment;
  segment.suppress_unit_conversion = owner.lenient_flag("suppressUnitConversion", warnings);
  Transformation& transformation = segment.transformation;
  for (const TransformationKind kind :
       {TransformationKind::Linear, TransformationKind::BooleanMapping,
        TransformationKind::IntegerMapping, TransformationKind::EnumerationMapping}) {
    const auto element = owner.child({kSsc, core::name(kind)});
    if (!element) continue;
    if (transformation.kind != TransformationKind::None) {
      element->fail(fmt::format("{} is a second transformation; the first is in line {}",
                                element->tag(), transformation.where.line),
                    "keep one of the two");
    }
    transformation.kind = kind;
    transformation.where = element->where();
    if (kind == TransformationKind::Linear) {
      read_linear(*element, transformation);
    } else {
      read_mapping(*element, transformation, warnings);
    }
  }
  return segment;
}

}  // namespace stride::ssp
