// The values at the start of a run.
#ifndef STRIDE_MASTER_ALGORITHM_LOOPS_INITIAL_VALUES_H
#define STRIDE_MASTER_ALGORITHM_LOOPS_INITIAL_VALUES_H

#include <stride/time.h>

#include "master/algorithm/run_context.h"

namespace stride::core {

/// The units are in Initialization Mode. Reads each connected output after all that it depends on,
/// and writes each connected input; algebraic loops are solved. So values pass through a chain of
/// units of any length before the first step, and a unit is called only as often as the declared
/// dependencies require. Throws Error (Run): a connected output is NaN, or no solution of a loop
/// was found.
void set_initial_values(RunContext& context, Time start);

}  // namespace stride::core

#endif
