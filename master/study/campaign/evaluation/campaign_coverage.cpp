#include "master/study/campaign/evaluation/campaign_coverage.h"

#include "master/observe/coverage/merge.h"
#include "master/system/declaration/scenario.h"

namespace stride::campaign {

CampaignCoverage::CampaignCoverage(const Plan& plan, CaseDefinitions& definitions)
    : scenario_(scenario::stem(plan.campaign().scenario)), definitions_(definitions) {}

void CampaignCoverage::add(const CaseResult& result, std::uint64_t index) {
  if (!result.coverage || definitions_.of_scenario().empty()) return;
  const auto* const definitions = definitions_.of(*result.coverage, index);
  if (definitions == nullptr) {
    ++unknown_;
    return;
  }
  const auto [report, is_new] = reports_.try_emplace(result.coverage->definition);
  if (is_new) report->second = coverage::empty_report(scenario_, *definitions, 0);
  add_case(report->second, *definitions, result.coverage->bins, index);
}

std::optional<coverage::Report> CampaignCoverage::report() const {
  if (definitions_.of_scenario().empty()) return std::nullopt;
  if (reports_.empty()) {
    coverage::Report nothing = coverage::empty_report(scenario_, definitions_.of_scenario(), 0);
    nothing.cases = 0;
    return nothing;
  }
  coverage::Report all = reports_.begin()->second;
  for (auto next = std::next(reports_.begin()); next != reports_.end(); ++next) {
    merge(all, next->second);
  }
  return all;
}

}  // namespace stride::campaign
