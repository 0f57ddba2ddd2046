#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_UNKNOWN_VARIABLE_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_UNKNOWN_VARIABLE_H

#include "master/base/error.h"
#include "master/engine/model/description.h"
#include "master/engine/model/system_declaration.h"

namespace stride::core {

/// Throws Error (Input): the component in the context has no such variable. With `system` the
/// message includes what its connections expect there: "an input Float64 in m, fed by
/// 'world.height'". Without `has_hint` no near name is looked for, which takes the most time by
/// far.
[[noreturn]] void fail_unknown_variable(const Context& context, const UnitDescription& description,
                                        const SystemDeclaration* system = nullptr,
                                        bool has_hint = true);

/// Throws Error (Input) if several variables of the component in the context have its variable's
/// name, and are not the same.
void check_unambiguous(const Context& context, const UnitDescription& description);

}  // namespace stride::core

#endif
