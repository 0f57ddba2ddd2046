#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_RUN_JSON_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_RUN_JSON_H

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/statistics.h"
#include "master/engine/run/simulation.h"
#include "master/engine/run/verdict.h"
#include "master/observe/recorders/provenance.h"
#include "master/observe/recorders/results_folder.h"

namespace stride::recorders {

/// Of a component, in percent; nothing where no point has bins that count.
struct CoverageSummary {
  std::string component;
  std::optional<double> percentage;
  std::optional<double> goal;
};

/// What is reported of a run.
struct RunRecord {
  std::filesystem::path scenario;
  const core::System& system;
  const core::RunOptions& options;
  Provenance provenance{};
  const core::RunStatistics& statistics;
  std::span<const core::Verdict> verdicts{};
  std::optional<std::string> error{};  ///< that ended the run, if one did
  bool is_over = true;                 ///< else there are no statistics yet
  ResultFiles files{};
  std::span<const Plot> plots{};
  std::span<const CoverageSummary> coverage{};
};

/// run.json: what was run and from what, how far it came, what each unit did and cost, and what the
/// other results hold. Times are in seconds. The wall-clock times differ from run to run, so unlike
/// the other results this file does, too. It is there as a whole or not at all. Throws core::Error.
void write_run_json(const std::filesystem::path& file, const RunRecord& record);

/// Whether the run is not over. Throws as add_error() does.
bool is_running(const std::filesystem::path& file);

/// Why the run has failed; nothing if it has not, or is not over. Throws likewise.
std::optional<std::string> error_in(const std::filesystem::path& file);

/// Makes the run.json of a run one that has failed, for what has failed after it was written. A run
/// that was not over has reached this time. Returns false if it has an error already, which stays.
/// Throws core::Error (Run) if that cannot be read or written.
bool add_error(const std::filesystem::path& file, const std::string& error,
               std::optional<Time> reached = {});

}  // namespace stride::recorders

#endif
