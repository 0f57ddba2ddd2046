// A plan in JSON: all that it was made of.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_JSON_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_JSON_H

#include <filesystem>
#include <string>

#include "master/study/campaign/plan.h"

namespace stride::campaign {

/// 64 hexadecimal digits that stand for all that decides the results of a plan and what is kept of
/// them, but not for the paths of its files.
std::string plan_identity(const Plan& plan);

/// The object in campaign.json of this folder, indented, with a line feed at its end. The same plan
/// gives the same bytes.
std::string plan_json(const Plan& plan, const std::filesystem::path& folder);

}  // namespace stride::campaign

#endif
