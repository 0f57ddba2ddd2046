// stride run --checkpoint: the state of a run, written while it goes on.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_CHECKPOINTS_H
#define STRIDE_MASTER_FRONT_CLI_RUN_CHECKPOINTS_H

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/run_control.h"
#include "master/observe/checkpoint/checkpoint_file.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// At which simulated times the state of a run is written, each time at the first communication
/// point that is not earlier.
struct CheckpointTimes {
  std::vector<Time> at{};
  std::optional<Duration> every{};  ///< counted from the start of the run
  bool on_signal = false;           ///< where SIGINT, SIGTERM or SIGHUP ends the run

  bool are_wanted() const { return !at.empty() || every || on_signal; }
};

/// --checkpoint, --checkpoint-every, --checkpoint-on-signal. `times` must outlive the command line.
void add_checkpoint_options(CLI::App& command, CheckpointTimes& times);

/// The folder in that of the results.
inline constexpr const char* kCheckpointsFolder = "checkpoints";

/// The checkpoints in a results folder, the earliest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& results);

/// Removes those of an earlier run, whose results are about to be replaced.
void remove_checkpoints(const std::filesystem::path& results);

/// Writes the checkpoints of a run into its results folder: checkpoint_SECONDS.zip for the times
/// that were named, which all stay, and latest_SECONDS.zip for the others, of which the last two
/// stay. What cannot be written is a warning, and require_all() an error, so a full disk ends no
/// run. A unit that fails ends it.
class Checkpoints final : public core::RunControl {
 public:
  /// The state of the run, at a communication point.
  using Take = std::function<checkpoint::Checkpoint(Time now)>;

  /// Of a run; a resumed one begins where its checkpoint is, at and before which none is written.
  struct Span {
    Time start, begin, stop;
  };

  /// Throws core::Error (Input) for times outside of the run.
  Checkpoints(CheckpointTimes times, const Span& span, std::filesystem::path results, Take take);

  std::optional<core::Pause> next(Time now) override;
  void on_pause(Time now) override;
  void on_interruption(Time now) override;

  /// The one that was written where the run was interrupted; empty if none was.
  const std::filesystem::path& at_interruption() const { return at_interruption_; }
  /// Throws core::Error (Run) if one of them could not be written.
  void require_all() const;

 private:
  Time next_periodic(Time now) const;
  std::filesystem::path write(Time now, const char* prefix);
  void drop_older() const;

  CheckpointTimes times_;  ///< those that are still to come
  Time start_;
  std::optional<Time> periodic_;  ///< the next one
  std::filesystem::path results_;
  Take take_;
  std::filesystem::path at_interruption_;
  std::vector<std::string> failures_;
};

}  // namespace stride::cli

#endif
