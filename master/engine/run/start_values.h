// What units are given before their initialisation.
#ifndef STRIDE_MASTER_ENGINE_RUN_START_VALUES_H
#define STRIDE_MASTER_ENGINE_RUN_START_VALUES_H

#include "master/engine/run/context/run_context.h"

namespace stride::core {

/// Sets the structural parameters, in Configuration Mode. They give arrays their sizes, so they are
/// set first.
void configure(RunContext& context);
/// Sets the other start values, before Initialization Mode.
void set_start_values(RunContext& context);

}  // namespace stride::core

#endif
