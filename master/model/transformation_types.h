// Which types the transformations of SSP are for.
#ifndef STRIDE_MASTER_MODEL_TRANSFORMATION_TYPES_H
#define STRIDE_MASTER_MODEL_TRANSFORMATION_TYPES_H

#include <string>

#include "master/model/conversion.h"

namespace stride::core {

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
