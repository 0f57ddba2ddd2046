// Cases that a search makes up, one batch after the other.
#ifndef STRIDE_MASTER_CLI_LISTED_CASES_H
#define STRIDE_MASTER_CLI_LISTED_CASES_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "master/campaign/campaign_scenario.h"
#include "master/campaign/case_folder.h"
#include "master/campaign/case_record.h"
#include "master/campaign/plan.h"
#include "master/search/search.h"

namespace stride::cli {

/// A growing campaign whose cases are listed, with records in a folder: what has one is not run
/// again. The scenario, and what `origin` refers to, must outlive it.
class ListedCases final : public search::Cases {
 public:
  /// `origin`: the plan whose parameters and settings the cases have. `seeds`: the values of its
  /// seeds, the same in all cases, so that parameters alone make a difference.
  ListedCases(const campaign::Plan& origin, const campaign::CampaignScenario& scenario,
              search::Row seeds, std::filesystem::path folder, std::size_t jobs);

  /// Runs them, at the same time as far as there are jobs.
  bool add(std::vector<search::Row> rows) override;
  std::size_t size() const override { return rows_.size(); }
  const campaign::CaseResult& result(std::uint64_t index) const override { return results_[index]; }

  /// All of them, as of a campaign whose seeds are parameters, too. There has to be one.
  const campaign::Plan& plan() const { return *plan_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  campaign::Plan make_plan() const;

  const campaign::Plan& origin_;
  const campaign::CampaignScenario& scenario_;
  const search::Row seeds_;
  const std::filesystem::path folder_;
  const std::size_t jobs_;
  std::vector<search::Row> rows_;  ///< with the seeds
  std::vector<campaign::CaseResult> results_;
  std::unique_ptr<const campaign::Plan> plan_;
};

/// The values of the seeds in a case of the plan.
search::Row seeds_of(const campaign::Plan& plan, const campaign::Case& row);

}  // namespace stride::cli

#endif
