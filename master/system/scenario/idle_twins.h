// Second instances of units that may be suspended, which never are.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_IDLE_TWINS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_IDLE_TWINS_H

#include <cstddef>
#include <vector>

#include "master/engine/model/system_declaration.h"

namespace stride::scenario {

/// Two components with the same FMU, start values and sources of their inputs.
struct IdleTwin {
  std::size_t unit = 0;  ///< index of the component
  std::size_t twin = 0;  ///< likewise, of the one that is not suspended, whose outputs go nowhere
};

/// Adds a twin of each component that can promise to be idle (org.stride.idle), behind all others.
/// The components have their descriptions.
std::vector<IdleTwin> add_idle_twins(core::SystemDeclaration& system);

}  // namespace stride::scenario

#endif
