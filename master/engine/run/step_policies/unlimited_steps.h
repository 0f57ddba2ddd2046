// What a run misses whose steps are as long as the time between two events.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_UNLIMITED_STEPS_H
#define STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_UNLIMITED_STEPS_H

#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"

namespace stride::core {

/// Whether no step of the run has to end before an event or the stop time: the policy adds no
/// communication point, or its grid is as long as the run. With a maximum step, of the user or of a
/// unit, steps are limited, however long it is.
bool has_unlimited_steps(const System& system, const RunOptions& options);

/// The connections, "a.y → b.u", whose value may change without an event: that of a continuous
/// output, and of any output that is no message where its unit has no Event Mode. With unlimited
/// steps it reaches the other unit at events only.
std::vector<std::string> connections_without_events(const System& system);

}  // namespace stride::core

#endif
