// What a variable may depend on by connections.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_UPSTREAM_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_UPSTREAM_H

#include <cstddef>
#include <vector>

#include "master/engine/model/system/system.h"

namespace stride::core {

/// The components that may have an effect on the variable, the nearest first, if each output of a
/// unit depends on all its inputs: of an input those that it is connected to, of any other variable
/// its own component, and then all from which connections lead to these.
std::vector<std::size_t> components_upstream(const System& system, VariableId id);

}  // namespace stride::core

#endif
