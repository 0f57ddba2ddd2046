// Where the results of a run go.
#ifndef STRIDE_MASTER_STUDY_RESULTS_RESULTS_TARGET_H
#define STRIDE_MASTER_STUDY_RESULTS_RESULTS_TARGET_H

#include <filesystem>
#include <optional>
#include <string>

#include <stride/time.h>

#include "master/engine/run/context/run_options.h"
#include "master/observe/recorders/results_folder.h"
#include "master/system/plan/run_plan.h"

namespace stride::results {

/// The folder, and which files are written.
struct ResultsTarget {
  std::filesystem::path folder;
  recorders::ResultFiles files;
};

/// No file is written.
inline recorders::ResultFiles no_files() { return {{}, {}, {}, {}, {}, {}, {}}; }
/// Those that the scenario names, without what this build cannot write, or the run does not have.
recorders::ResultFiles possible_files(const scenario::RunPlan& loaded);

/// Those of the scenario; values that no file has are not read from the units.
core::RunOptions options_for(const scenario::RunPlan& loaded, const recorders::ResultFiles& files);

/// Makes the folder of a run. Throws core::Error (Input) if that is not possible, or a file of the
/// results would be one that the scenario is made of.
void make_folder(const ResultsTarget& target, const scenario::RunPlan& loaded);

/// Adds an error to the run.json of a run that is over, or will not end by itself, and makes its
/// report anew; `reached` is the time in the latter case. Does nothing if there is no run.json, or
/// if it has an error already. Throws as recorders::add_error() and write_report() do.
void add_error(const ResultsTarget& target, const std::string& error,
               std::optional<Time> reached = {});

}  // namespace stride::results

#endif
