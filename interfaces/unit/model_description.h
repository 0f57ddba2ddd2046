#ifndef STRIDE_INTERFACES_UNIT_MODEL_DESCRIPTION_H
#define STRIDE_INTERFACES_UNIT_MODEL_DESCRIPTION_H

#include <string>

#include "interfaces/unit/table.h"

namespace stride::kit {

/// The text of modelDescription.xml (FMI 3.0, 2.4). The instantiation token is a hash of everything
/// else in it and of the idle manifest, so it changes exactly when one of them does.
std::string model_description(const std::string& name, const Unit& unit, const Table& table);

/// The token alone.
std::string instantiation_token(const std::string& name, const Unit& unit, const Table& table);

}  // namespace stride::kit

#endif
