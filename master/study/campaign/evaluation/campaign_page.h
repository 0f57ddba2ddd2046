// campaign.html: what became of the cases of a campaign, on one page that needs nothing else.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_PAGE_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_PAGE_H

#include <cstdint>
#include <filesystem>
#include <string>

#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

inline constexpr const char* kCampaignPage = "campaign.html";
/// What the page holds; of more cases it has a sample, see read_case_columns().
inline constexpr std::uint64_t kMostShownCases = 100'000;

/// Writes the page to the file, which has its new content at once or not at all. Records that are
/// missing are shown as such. `report` is the name of the page in the results of a case; links to
/// it are relative. The same records make the same bytes.
/// Throws core::Error (Input) in a build without pages, and if the file cannot be written.
void write_campaign_page(const std::filesystem::path& file, const Plan& plan,
                         const CaseFolder& cases, const std::string& report,
                         CaseDefinitions coverage = {}, std::uint64_t most_cases = kMostShownCases);

}  // namespace stride::campaign

#endif
