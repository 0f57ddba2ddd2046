// stride campaign run and status, and what other commands print of a campaign.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_RUN_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_RUN_H

#include "master/study/campaign/evaluation/case_table.h"

namespace CLI {
class App;
}

namespace stride::cli {

class CampaignInput;

/// Makes the table, and prints how many cases are done, and failures. Throws core::Error (Input)
/// where there is no plan.
campaign::CaseSummary print_status(const CampaignInput& input);
/// Throws core::Error (Run) if a case has not passed, or the campaign was interrupted.
void require_all_passed(const CampaignInput& input, const campaign::CaseTotals& totals);

/// Of a campaign that is complete: throws core::Error (Run) if it misses a goal of its coverage.
void require_goals(const CampaignInput& input, const campaign::CaseSummary& summary);

void add_campaign_run(CLI::App& group);
void add_campaign_status(CLI::App& group);

}  // namespace stride::cli

#endif
