// The digests of what a scenario consists of.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_SCENARIO_DIGESTS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_SCENARIO_DIGESTS_H

#include <filesystem>
#include <map>
#include <string>

#include "master/base/files/file_digests.h"
#include "master/system/plan/run_plan.h"

namespace stride::campaign {

/// Of the system files and parameter sets, by their paths from the folder of the scenario.
std::map<std::string, std::string> scenario_digests(const scenario::Scenario& scenario,
                                                    core::FileDigests& digests);
/// Of the unit of a component: an archive, a folder with all that is in it, or a library with its
/// resources.
std::string unit_digest(const scenario::RunPlan& loaded, std::size_t component,
                        core::FileDigests& digests);

}  // namespace stride::campaign

#endif
