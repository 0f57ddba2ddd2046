// stride campaign report: the page of a campaign.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_REPORT_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_REPORT_H

#include <filesystem>

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/study/campaign/cases/case_folder.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// Throws core::Error.
void write_campaign_report(const std::filesystem::path& file, const CampaignInput& input,
                           const campaign::CaseFolder& cases);

void add_campaign_report(CLI::App& group);

}  // namespace stride::cli

#endif
