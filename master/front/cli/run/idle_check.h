// stride run --check-idle: whether idle skipping changes what a run shows.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_IDLE_CHECK_H
#define STRIDE_MASTER_FRONT_CLI_RUN_IDLE_CHECK_H

#include <filesystem>
#include <string>

#include "master/engine/run/context/statistics.h"
#include "master/front/cli/run/recorded_run.h"
#include "master/system/plan/run_plan.h"

namespace stride::cli {

/// The folder, within that of the results, with those of the run without idle skipping.
inline constexpr const char* kFullRunFolder = "no_idle_skip";

/// Compares the recorded signals and the messages of a run with those of one without idle skipping,
/// which is in the folder `full`. Messages are equal, and so are values, but for those of
/// floating-point outputs: one with a tolerance may be off by that of all units together, tolerance
/// times number of units that have such outputs, and one without by a thousandth of its greatest
/// value, if another unit's tolerance or deadband may have an effect on it. Returns, for people,
/// what was compared. Throws core::Error (Run) that names the first difference, with the variable
/// and the simulated time, and the units that were suspended on which it depends. `statistics`: of
/// the run with skipping.
std::string compare_with_full_run(const scenario::RunPlan& loaded,
                                  const core::RunStatistics& statistics,
                                  const results::ResultsTarget& skipping,
                                  const std::filesystem::path& full);

}  // namespace stride::cli

#endif
