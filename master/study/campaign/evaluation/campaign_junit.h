// What a campaign leaves for continuous integration.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_JUNIT_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_JUNIT_H

#include <filesystem>

#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

/// A test report in the XML of JUnit: a test suite with a test case for each case of the campaign.
/// One without a record is skipped. The file is there as a whole or not at all. Throws core::Error
/// if it cannot be written.
void write_campaign_junit(const std::filesystem::path& file, const Plan& plan,
                          const CaseFolder& cases, const CaseTotals& totals);

}  // namespace stride::campaign

#endif
