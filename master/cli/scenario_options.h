#ifndef STRIDE_MASTER_CLI_SCENARIO_OPTIONS_H
#define STRIDE_MASTER_CLI_SCENARIO_OPTIONS_H

#include "master/scenario/loaded_scenario.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// The options that every command on a scenario has. `request` must outlive the command line.
void add_scenario_options(CLI::App& command, scenario::ScenarioRequest& request);

/// Those of them that change something in the middle of a run.
void add_intervention_options(CLI::App& command, scenario::ScenarioRequest& request);

}  // namespace stride::cli

#endif
