// What the cases of a campaign have covered together.
#ifndef STRIDE_MASTER_CAMPAIGN_CAMPAIGN_COVERAGE_H
#define STRIDE_MASTER_CAMPAIGN_CAMPAIGN_COVERAGE_H

#include <cstdint>
#include <optional>
#include <span>

#include "master/campaign/case_record.h"
#include "master/campaign/plan.h"
#include "master/coverage/definition.h"
#include "master/coverage/report.h"

namespace stride::campaign {

/// Of the cases with the same definition of coverage as the scenario: one in which units are others
/// may have another one, and is not counted.
class CampaignCoverage {
 public:
  /// `definitions`, of the scenario, must outlive this object.
  CampaignCoverage(const Plan& plan, std::span<const coverage::GroupDefinition> definitions);

  /// In ascending order of the index.
  void add(const CaseResult& result, std::uint64_t index);

  /// Nothing if the scenario declares no coverage.
  const std::optional<coverage::Report>& report() const { return report_; }
  /// How many cases have another definition.
  std::uint64_t otherwise_covered() const { return otherwise_covered_; }

 private:
  std::span<const coverage::GroupDefinition> definitions_;
  std::optional<coverage::Report> report_;
  std::uint64_t otherwise_covered_ = 0;
};

}  // namespace stride::campaign

#endif
