#ifndef STRIDE_INTERFACES_UNIT_IDLE_MANIFEST_H
#define STRIDE_INTERFACES_UNIT_IDLE_MANIFEST_H

#include <string>

#include "interfaces/unit/table.h"

namespace stride::kit {

/// The text of the manifest of org.stride.idle (docs/idle.md); empty for a unit that does not
/// promise to be idle.
std::string idle_manifest(const Unit& unit, const Table& table);

}  // namespace stride::kit

#endif
