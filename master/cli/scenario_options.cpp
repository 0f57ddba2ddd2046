#include "master/cli/scenario_options.h"

#include <CLI/CLI.hpp>

namespace stride::cli {

void add_scenario_options(CLI::App& command, ScenarioRequest& request) {
  command.add_option("FILE", request.scenario, "The scenario, an SSP system file (.ssd)")
      ->required()
      ->type_name("");
  command.add_option("--stop", request.stop, "Simulated time at which to end")
      ->type_name("SECONDS");
  command.add_option("--step", request.step, "Communication step size")->type_name("SECONDS");
  command
      .add_option("--set", request.sets,
                  "Start value of a parameter or input; may be given several times")
      ->type_name("COMPONENT.VARIABLE=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--swap", request.swaps,
                  "Another unit for a component; may be given several times")
      ->type_name("COMPONENT=FILE.fmu")
      ->allow_extra_args(false);
  command
      .add_option(
          "--signals", request.signals,
          "Which variables to record, instead of the scenario's choice, such as 'sensor.*'; "
          "may be given several times")
      ->type_name("GLOB")
      ->allow_extra_args(false);
}

}  // namespace stride::cli
