// The values with which a run begins.
#ifndef STRIDE_MASTER_ALGORITHM_LOOPS_INITIAL_VALUES_H
#define STRIDE_MASTER_ALGORITHM_LOOPS_INITIAL_VALUES_H

#include <stride/time.h>

#include "master/algorithm/run_context.h"

namespace stride::core {

/// The units are in Initialization Mode. Reads each connected
/// output once what it depends on is known, and writes each connected input; algebraic loops are
/// solved. So a value is where it belongs before the first step, however long its way, and a unit
/// is asked as often only as the declared dependencies demand. Throws Error (Run): a connected
/// output is NaN, or no solution of a loop was found.
void set_initial_values(RunContext& context, Time start);

}  // namespace stride::core

#endif
