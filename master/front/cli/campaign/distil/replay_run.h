// A run of a replay in a process of its own.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_REPLAY_RUN_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_REPLAY_RUN_H

#include <filesystem>
#include <optional>
#include <string>

namespace stride::cli {

struct ReplayRun {
  std::filesystem::path scenario;
  std::filesystem::path results;  ///< a folder, which is made
  std::string device;             ///< the component whose stimuli are captured again,
  std::filesystem::path stimuli;  ///< into a file of its name in this folder, which is made
};

/// Runs it, and prints nothing. Nothing if it has passed, otherwise why not. Throws core::Error
/// (Run) if it was interrupted, or could not run for want of something that the machine lacks.
std::optional<std::string> run_replay(const ReplayRun& replay);

}  // namespace stride::cli

#endif
