// Descriptions of units that stay on other machines, kept where results are: whoever reads these
// needs no machine.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_KEPT_DESCRIPTIONS_H
#define STRIDE_MASTER_SYSTEM_PLAN_KEPT_DESCRIPTIONS_H

#include <filesystem>
#include <span>

#include "master/system/plan/run_plan.h"

namespace stride::scenario {

/// Writes those of these scenarios to an archive, and none if they have no such unit. Throws
/// core::Error.
void keep_descriptions(std::span<const RunPlan* const> scenarios,
                       const std::filesystem::path& file);

/// For ScenarioRequest::units; empty if there is no such file. Throws core::Error (Input) for
/// another file.
UnitStore kept_descriptions(const std::filesystem::path& file);

}  // namespace stride::scenario

#endif
