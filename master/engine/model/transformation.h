// The transformations of SSP, and which types they are for.
#ifndef STRIDE_MASTER_ENGINE_MODEL_TRANSFORMATION_H
#define STRIDE_MASTER_ENGINE_MODEL_TRANSFORMATION_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/description.h"
#include "master/engine/model/unit_of_measure.h"

namespace stride::core {

/// Integer mapping, sorted by source; unmapped numbers are unchanged.
using NumberMap = std::vector<std::pair<std::int64_t, std::int64_t>>;

using EnumerationItems = std::vector<std::pair<std::string, std::int64_t>>;

/// A transformation of SSP (2.0, section "Transformation Choice"), applied after the conversion of
/// units of measure. Where a connection changes the type, too, it is applied to the end that has
/// the type which it is for: before the change, or after it.
struct Transformation {
  enum class Kind { None, Linear, BooleanMapping, IntegerMapping, EnumerationMapping };
  Kind kind = Kind::None;
  LinearConversion linear{};
  NumberMap numbers{};                                       ///< of Boolean and integer mappings
  std::vector<std::pair<std::string, std::string>> names{};  ///< of Enumerations, by their items
  Location where{};
};

/// "LinearTransformation", the name of its element.
const char* name(Transformation::Kind kind);
/// "an IntegerMappingTransformation".
std::string name_with_article(Transformation::Kind kind);
/// What it is for, in words: "integers and Enumerations".
const char* types_of(Transformation::Kind kind);

/// Whether it is for one of the ends of a connection, whose types are convertible.
bool is_for(Transformation::Kind kind, ValueType from, ValueType to);
/// Likewise, for a text that becomes a value of this type.
bool is_for_text(Transformation::Kind kind, ValueType to);

/// What transforms values between these types, for a hint.
const char* transformation_for(ValueType from, ValueType to);

}  // namespace stride::core

#endif
