// What the cases of a campaign have covered together.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_COVERAGE_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CAMPAIGN_COVERAGE_H

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "master/observe/coverage/report.h"
#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

/// Merged point by point: what has other bins in some cases, since their units are others, is
/// beside the rest, as coverage::merge() has it.
class CampaignCoverage {
 public:
  /// The definitions must outlive this object.
  CampaignCoverage(const Plan& plan, CaseDefinitions& definitions);

  /// In any order of the index.
  void add(const CaseResult& result, std::uint64_t index);

  /// Nothing if the scenario declares no coverage. Without any case that of the scenario, with
  /// nothing hit.
  std::optional<coverage::Report> report() const;
  /// How many cases are not in it, since nothing says any more which bins they had.
  std::uint64_t unknown() const { return unknown_; }

 private:
  const std::string scenario_;
  CaseDefinitions& definitions_;
  std::map<std::string, coverage::Report> reports_;  ///< by the hashes of their definitions
  std::uint64_t unknown_ = 0;
};

}  // namespace stride::campaign

#endif
