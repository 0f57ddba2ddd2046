#ifndef STRIDE_MASTER_MODEL_UNKNOWN_VARIABLE_H
#define STRIDE_MASTER_MODEL_UNKNOWN_VARIABLE_H

#include "master/model/description.h"
#include "master/model/system_declaration.h"
#include "master/util/error.h"

namespace stride::core {

/// Throws Error (Input): the component in the context has no such variable. With `system` the
/// message includes what its connections expect there: "an input Float64 in m, fed by
/// 'world.height'".
[[noreturn]] void fail_unknown_variable(const Context& context, const UnitDescription& description,
                                        const SystemDeclaration* system = nullptr);

}  // namespace stride::core

#endif
