// Whether the values of a plan fit its scenario.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_CHECK_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_CHECK_H

#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

/// Type and range of each start value, with each unit that a swap brings; the names of units; and
/// the interventions of each case. The scenario is not loaded again. Throws core::Error (Input),
/// which lists what does not fit.
void check_plan(const Plan& plan, const CampaignScenario& scenario);

}  // namespace stride::campaign

#endif
