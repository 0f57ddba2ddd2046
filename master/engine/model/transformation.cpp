#include "master/engine/model/transformation.h"

#include <cstddef>

#include "master/engine/model/number_range.h"

namespace stride::core {
namespace {

bool is_number_or_boolean(ValueType type) { return range_of(type) || type == ValueType::Boolean; }

}  // namespace

const char* name(Transformation::Kind kind) {
  constexpr const char* kNames[] = {"", "LinearTransformation", "BooleanMappingTransformation",
                                    "IntegerMappingTransformation",
                                    "EnumerationMappingTransformation"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string name_with_article(Transformation::Kind kind) {
  const bool has_vowel = kind == Transformation::Kind::IntegerMapping ||
                         kind == Transformation::Kind::EnumerationMapping;
  return (has_vowel ? "an " : "a ") + std::string(name(kind));
}

bool is_for(Transformation::Kind kind, ValueType from, ValueType to) {
  const auto either = [&](auto&& is_right) { return is_right(from) || is_right(to); };
  switch (kind) {
    case Transformation::Kind::None:
      return true;
    case Transformation::Kind::Linear:
      return is_real(to);
    case Transformation::Kind::BooleanMapping:
      return either([](ValueType type) { return type == ValueType::Boolean; });
    case Transformation::Kind::IntegerMapping:
      return either(is_integer);
    case Transformation::Kind::EnumerationMapping:
      return from == ValueType::Enumeration && to == ValueType::Enumeration;
  }
  return false;
}

bool is_for_text(Transformation::Kind kind, ValueType to) {
  const bool is_mapping =
      kind == Transformation::Kind::BooleanMapping || kind == Transformation::Kind::IntegerMapping;
  if (is_mapping) return is_number_or_boolean(to);
  return is_for(kind, to, to);
}

const char* types_of(Transformation::Kind kind) {
  constexpr const char* kTypes[] = {"any type", "Float64 and Float32", "Boolean",
                                    "integers and Enumerations", "Enumerations"};
  return kTypes[static_cast<std::size_t>(kind)];
}

const char* transformation_for(ValueType from, ValueType to) {
  if (is_for(Transformation::Kind::EnumerationMapping, from, to)) {
    return "an <ssc:EnumerationMappingTransformation>";
  }
  if (is_number_or_boolean(from) && is_real(to)) {
    return "a <ssc:LinearTransformation factor=\"…\" offset=\"…\"/>";
  }
  if (is_for(Transformation::Kind::IntegerMapping, from, to)) {
    return "an <ssc:IntegerMappingTransformation>";
  }
  if (from == ValueType::Boolean) return "a <ssc:BooleanMappingTransformation>";
  return "a unit between the two; SSP has no transformation for them";
}

}  // namespace stride::core
