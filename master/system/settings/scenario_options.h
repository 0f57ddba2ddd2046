// What a user may want of a scenario, by the names and in the words of the command line.
#ifndef STRIDE_MASTER_SYSTEM_SETTINGS_SCENARIO_OPTIONS_H
#define STRIDE_MASTER_SYSTEM_SETTINGS_SCENARIO_OPTIONS_H

#include <cstddef>
#include <filesystem>
#include <string>

#include "master/system/plan/request.h"

namespace CLI {
class App;
}

namespace stride::settings {

/// The scenario that a command works on, of these kinds of files: "An SSP system file (.ssd)". A
/// name becomes the file that it stands for (scenario::named_scenario). `scenario` must outlive the
/// command line.
void add_scenario_argument(CLI::App& command, std::filesystem::path& scenario,
                           const std::string& kinds);

/// The scenario, and the options that every command on a scenario has. `request` must outlive the
/// command line.
void add_scenario_options(CLI::App& command, scenario::ScenarioRequest& request);

/// Those of them that change something in the middle of a run.
void add_intervention_options(CLI::App& command, scenario::ScenarioRequest& request);

/// Those of a run: what is looked at in it.
void add_observation_options(CLI::App& command, scenario::ScenarioRequest& request);

/// On how many threads it may step its units.
void add_thread_option(CLI::App& command, std::size_t& threads);

}  // namespace stride::settings

#endif
