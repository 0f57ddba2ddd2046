// What `stride run` is asked for.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_RUN_ARGUMENTS_H
#define STRIDE_MASTER_FRONT_CLI_RUN_RUN_ARGUMENTS_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "master/front/cli/run/branches.h"
#include "master/front/cli/run/checkpoints.h"
#include "master/front/cli/terminal/progress.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/system/plan/request.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// A run that goes on.
struct Resumption {
  checkpoint::Checkpoint from;
  std::filesystem::path file;       ///< of the checkpoint
  std::filesystem::path results{};  ///< where the results up to it are
  bool has_other_signals = false;   ///< than those recorded before: their files begin anew
  /// Files outside of the results that go on elsewhere: from, to.
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> copies{};
};

/// Why work in a process of its own has failed.
struct ChildFailure {
  std::string text;
  bool is_of_input = false;  ///< what the user gave is wrong
};

/// The value of a flag without one: --live.
inline constexpr const char* kAnyLivePort = "true";

struct RunArguments {
  scenario::ScenarioRequest scenario;
  std::filesystem::path out;
  std::vector<std::string> captures;  ///< "component=FILE"
  std::filesystem::path junit;        ///< empty: none
  CheckpointTimes checkpoints{};
  BranchOptions branches{};
  std::shared_ptr<const Resumption> resumed{};  ///< null: the run begins at its start
  std::size_t threads = 1;
  std::optional<ProgressStyle> progress;
  std::optional<double>
      real_time{};     ///< simulated seconds in one of the wall clock; none: no limit
  std::string live{};  ///< a port, or kAnyLivePort; empty: no live report
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

/// Those of them that a resumed run has, too.
void add_thread_and_junit_options(CLI::App& command, RunArguments& arguments);
void add_display_options(CLI::App& command, RunArguments& arguments);

}  // namespace stride::cli

#endif
