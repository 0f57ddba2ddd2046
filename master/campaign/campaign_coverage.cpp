#include "master/campaign/campaign_coverage.h"

#include "master/scenario/scenario.h"

namespace stride::campaign {

CampaignCoverage::CampaignCoverage(const Plan& plan,
                                   std::span<const coverage::GroupDefinition> definitions)
    : definitions_(definitions) {
  if (definitions.empty()) return;
  report_ = coverage::empty_report(scenario::stem(plan.campaign().scenario), definitions);
  report_->cases = 0;
}

void CampaignCoverage::add(const CaseResult& result, std::uint64_t index) {
  if (!report_ || !result.coverage) return;
  if (result.coverage->definition != report_->definition) {
    ++otherwise_covered_;
    return;
  }
  ++*report_->cases;
  add_case(*report_, definitions_, result.coverage->bins, index);
}

}  // namespace stride::campaign
