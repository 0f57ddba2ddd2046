// Where the results of a run go.
#ifndef STRIDE_MASTER_RESULTS_RESULTS_TARGET_H
#define STRIDE_MASTER_RESULTS_RESULTS_TARGET_H

#include <filesystem>
#include <optional>
#include <string>

#include <stride/time.h>

#include "master/recorders/results_folder.h"

namespace stride::results {

/// The folder, and which files are written.
struct ResultsTarget {
  std::filesystem::path folder;
  recorders::ResultFiles files;
};

/// No file is written.
inline recorders::ResultFiles no_files() { return {{}, {}, {}, {}, {}, {}, {}}; }

/// Adds an error to the run.json of a run that is over, or will not end by itself, and makes its
/// report anew; `reached` is the time in the latter case. Does nothing if there is no run.json, or
/// if it has an error already. Throws as recorders::add_error() and write_report() do.
void add_error(const ResultsTarget& target, const std::string& error,
               std::optional<Time> reached = {});

}  // namespace stride::results

#endif
