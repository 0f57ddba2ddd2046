// A run as the command line wants it, from the scenario's files to the report.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_SCENARIO_RUN_H
#define STRIDE_MASTER_FRONT_CLI_RUN_SCENARIO_RUN_H

#include "master/front/cli/run/run_arguments.h"

namespace stride::cli {

/// Loads the scenario, runs it and writes its results. Throws core::Error: of the kind Input before
/// anything is run, of the kind Run where the run or one of its verdicts fails. Whatever ends it,
/// the test report contains it.
void run_scenario(RunArguments arguments);

}  // namespace stride::cli

#endif
