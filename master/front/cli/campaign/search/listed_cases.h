// Cases that a search makes up, one batch after the other.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_LISTED_CASES_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_LISTED_CASES_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_range.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"
#include "master/study/search/search.h"

namespace stride::cli {

/// Runs those cases of a batch, the last ones of the plan, that have no record in the folder, or
/// that of another case. False: those that made them up are not to go on.
using RunBatch = std::function<bool(const campaign::Plan& plan, const campaign::CaseFolder& cases,
                                    const campaign::CaseRange& batch)>;

/// In this process, `jobs` at the same time. The scenario must outlive it.
RunBatch local_batches(const campaign::CampaignScenario& scenario, std::size_t jobs);

/// Removes records that are those of other cases than the plan has by these indices: of another
/// tolerance, say. Nobody else may be at work on these cases.
void drop_others(const campaign::CaseFolder& cases, const campaign::CaseRange& range);

/// A growing campaign whose cases are listed, with records in a folder: what has one is not run
/// again. What `origin` refers to must outlive it.
class ListedCases final : public search::Cases {
 public:
  /// `origin`: the plan whose parameters and settings the cases have. `seeds`: the values of its
  /// seeds, the same in all cases, so that parameters alone make a difference. `run` is called for
  /// batches that are not complete.
  ListedCases(const campaign::Plan& origin, search::Row seeds, std::filesystem::path folder,
              RunBatch run);

  bool add(std::vector<search::Row> rows) override;
  std::size_t size() const override { return rows_.size(); }
  const campaign::CaseResult& result(std::uint64_t index) const override { return results_[index]; }

  /// All of them, as of a campaign whose seeds are parameters, too. There has to be one.
  const campaign::Plan& plan() const { return *plan_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  campaign::Plan make_plan() const;
  bool take_results(const campaign::CaseFolder& cases);

  const campaign::Plan& origin_;
  const search::Row seeds_;
  const std::filesystem::path folder_;
  const RunBatch run_;
  std::vector<search::Row> rows_;  ///< with the seeds
  std::vector<campaign::CaseResult> results_;
  std::unique_ptr<const campaign::Plan> plan_;
};

/// The values of the seeds in a case of the plan.
search::Row seeds_of(const campaign::Plan& plan, const campaign::Case& row);

}  // namespace stride::cli

#endif
