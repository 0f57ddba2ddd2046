#include "master/cli/session_options.h"

#include <CLI/CLI.hpp>

namespace stride::cli {

void add_session_options(CLI::App& command, SessionRequest& request) {
  command.add_option("FILE", request.scenario, "The scenario, an SSP system file (.ssd)")
      ->required();
  command.add_option("--stop", request.stop, "Simulated time at which to end [s]");
  command.add_option("--step", request.step, "Communication step size [s]");
  command
      .add_option("--set", request.sets,
                  "Start value of a parameter or input, as component.variable=value; several times")
      ->allow_extra_args(false);
  command
      .add_option("--swap", request.swaps,
                  "Another unit for a component, as component=FILE.fmu; several times")
      ->allow_extra_args(false);
  command
      .add_option("--signals", request.signals,
                  "Which variables to record, as a glob over component.variable such as "
                  "'sensor.*'; several times; instead of the scenario's choice")
      ->allow_extra_args(false);
}

}  // namespace stride::cli
