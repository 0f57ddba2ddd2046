// Which suspended units may be the cause of a difference.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_IDLE_CAUSE_H
#define STRIDE_MASTER_FRONT_CLI_RUN_IDLE_CAUSE_H

#include <optional>
#include <string>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/statistics.h"

namespace stride::cli {

/// For an error that runs with and without idle skipping differ, though no unit was found to break
/// its promises: names the units that were suspended on which what differs depends by connections,
/// the nearest first, and what can be done. Without a variable all units count.
std::string hint_on_cause(const core::System& system, const core::RunStatistics& statistics,
                          std::optional<core::VariableId> variable);

}  // namespace stride::cli

#endif
