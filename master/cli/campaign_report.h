// stride campaign report: the page of a campaign.
#ifndef STRIDE_MASTER_CLI_CAMPAIGN_REPORT_H
#define STRIDE_MASTER_CLI_CAMPAIGN_REPORT_H

#include <filesystem>

#include "master/campaign/case_folder.h"
#include "master/cli/campaign_input.h"

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
