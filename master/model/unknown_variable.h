#ifndef STRIDE_MASTER_MODEL_UNKNOWN_VARIABLE_H
#define STRIDE_MASTER_MODEL_UNKNOWN_VARIABLE_H

#include "master/model/system.h"

namespace stride::core {

/// Throws Error (Input): the component in the context, which has this description, has no such
/// variable. With the system it also says what is expected there, "an input Float64 in m, fed by
/// 'world.height'": what the connector does not declare is taken from the other ends of its
/// connections, as far as they are there.
[[noreturn]] void fail_unknown_variable(const Context& context, const UnitDescription& description,
                                        const SystemDeclaration* system = nullptr);

}  // namespace stride::core

#endif
