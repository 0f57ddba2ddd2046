// The units of a plan, loaded.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_INSTANCES_H
#define STRIDE_MASTER_SYSTEM_PLAN_INSTANCES_H

#include <csignal>
#include <filesystem>
#include <memory>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/system/plan/run_plan.h"

namespace stride::scenario {

/// Fresh instances in the order of system().components(). Their messages go to the log. The units
/// write their files to their folders in `results`, which exist (recorders::UnitFolders), and
/// hosted ones nowhere else; if it is empty, there are none. `interrupted` is set to another
/// value than 0 to end a wait for a unit; null = nothing is.
std::vector<std::unique_ptr<core::Unit>> instantiate(
    const RunPlan& plan, const std::filesystem::path& results = {},
    const volatile std::sig_atomic_t* interrupted = nullptr);

}  // namespace stride::scenario

#endif
