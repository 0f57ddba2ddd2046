// The communication step of a run for which nobody gives one.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_DEFAULT_STEP_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_DEFAULT_STEP_H

#include <stride/time.h>

namespace stride::scenario {

/// 1 ms. A run of more than 100 s has longer steps, about 100,000 of them, and one of less than
/// 0.1 s has shorter steps, about 100: 1, 2 or 5 times a power of ten.
Duration default_step(Duration run);

}  // namespace stride::scenario

#endif
