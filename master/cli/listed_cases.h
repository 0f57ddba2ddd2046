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

namespace stride::cli {

/// Values of Campaign::parameters, and then of Campaign::seeds.
using ListedRow = std::vector<campaign::Text>;

/// A growing campaign whose cases are listed, with records in a folder of its own: what has one is
/// not run again. The scenario, and what `origin` refers to, must outlive it.
class ListedCases {
 public:
  /// `origin`: the plan whose parameters, seeds and settings the cases have.
  ListedCases(const campaign::Plan& origin, const campaign::CampaignScenario& scenario,
              std::filesystem::path folder, std::size_t jobs);

  std::size_t size() const { return rows_.size(); }
  const ListedRow& row(std::uint64_t index) const { return rows_[index]; }
  const campaign::CaseResult& result(std::uint64_t index) const { return results_[index]; }

  /// Runs further cases, at the same time as far as there are jobs. False if it was interrupted:
  /// then they are not there.
  bool add(std::vector<ListedRow> rows);

  /// All of them, as of a campaign. There has to be one.
  const campaign::Plan& plan() const { return *plan_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  campaign::Plan make_plan() const;

  const campaign::Plan& origin_;
  const campaign::CampaignScenario& scenario_;
  std::filesystem::path folder_;
  std::size_t jobs_;
  std::vector<ListedRow> rows_;
  std::vector<campaign::CaseResult> results_;
  std::unique_ptr<const campaign::Plan> plan_;
};

}  // namespace stride::cli

#endif
