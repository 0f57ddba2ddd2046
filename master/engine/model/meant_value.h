#ifndef STRIDE_MASTER_ENGINE_MODEL_MEANT_VALUE_H
#define STRIDE_MASTER_ENGINE_MODEL_MEANT_VALUE_H

#include <optional>
#include <string>

#include "master/engine/model/description.h"

namespace stride::core {

/// The value that a text of another form is meant to be, which some tools write: "true" for "True"
/// or "TRUE", "2" for the "2.0" or "2e0" of an integer; between Booleans and numbers what a
/// connection makes of it, "1" for the "true" of a number, "true" for the "2" of a Boolean. Nothing
/// for any other text, and for other types.
std::optional<std::string> meant_value(ValueType type, const std::string& text);

}  // namespace stride::core

#endif
