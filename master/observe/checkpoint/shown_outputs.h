// What a unit shows at an instant.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_SHOWN_OUTPUTS_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_SHOWN_OUTPUTS_H

#include <cstdint>
#include <vector>

#include "master/engine/model/description.h"
#include "master/engine/port/unit.h"

namespace stride::checkpoint {

/// A hash of the value of each output that can be read in Step Mode, in the order of the
/// description. Throws core::Error where the unit fails.
std::vector<std::uint64_t> shown_outputs(core::Unit& unit,
                                         const core::UnitDescription& description);

/// The first output that is not what it was; null if all are.
const core::Variable* first_difference(core::Unit& unit, const core::UnitDescription& description,
                                       const std::vector<std::uint64_t>& before);

}  // namespace stride::checkpoint

#endif
