// stride run --check-idle: whether each unit of a scenario keeps its promises to be idle.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_PROMISE_CHECK_H
#define STRIDE_MASTER_FRONT_CLI_RUN_PROMISE_CHECK_H

#include "master/system/plan/run_plan.h"

namespace stride::cli {

/// Runs the scenario, each unit that may be suspended beside a second instance of it that never is
/// and gets the same inputs, so that a unit is blamed for what it does itself only. The second
/// instance sends the same messages, and has the same outputs, but for tolerances: an output that
/// has one may be off by it, and by what it was off after the last suspension. Where the unit has
/// deadbands, either may come a communication step later. Records nothing; units' files
/// are in a temporary folder. Throws core::Error, for the first difference with unit, variable and
/// simulated time. For a process of its own: there are no messages of units any more.
void run_beside_twins(scenario::ScenarioRequest request);

}  // namespace stride::cli

#endif
