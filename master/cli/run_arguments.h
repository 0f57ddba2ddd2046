// What `stride run` is asked for.
#ifndef STRIDE_MASTER_CLI_RUN_ARGUMENTS_H
#define STRIDE_MASTER_CLI_RUN_ARGUMENTS_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "master/cli/progress.h"
#include "master/scenario/loaded_scenario.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// Why work in a process of its own has failed.
struct ChildFailure {
  std::string text;
  bool is_of_input = false;  ///< what the user gave is wrong
};

struct RunArguments {
  scenario::ScenarioRequest scenario;
  std::filesystem::path out;
  std::vector<std::string> captures;  ///< "component=FILE"
  std::filesystem::path junit;        ///< empty: none
  std::size_t threads = 1;
  std::optional<ProgressStyle> progress;
  bool no_trace = false;
  bool no_report = false;
  bool open = false;  ///< the report
  bool quiet = false;
  bool check_idle = false;
  std::filesystem::path full_run{};  ///< the results without idle skipping to compare with
  std::optional<ChildFailure> promise_failure{}, full_run_failure{};
};

/// Where the results go: results/ and the scenario's name, if nothing else is named.
std::filesystem::path results_folder(const RunArguments& arguments);

/// The options of a run but --check-idle. `arguments` must outlive the command line.
void add_run_options(CLI::App& command, RunArguments& arguments);

}  // namespace stride::cli

#endif
