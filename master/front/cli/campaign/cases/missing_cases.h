// The cases of a campaign that are still to be run.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_MISSING_CASES_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_MISSING_CASES_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "master/front/cli/campaign/cases/campaign_progress.h"
#include "master/front/cli/campaign/cases/case_pool.h"
#include "master/front/cli/campaign/cases/case_runner.h"
#include "master/front/cli/terminal/progress.h"
#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_range.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan.h"
#include "master/study/campaign/shared_beginnings.h"

namespace stride::cli {

/// Of the process of a case.
isolation::ChildOptions case_options(const campaign::Campaign& campaign);

/// Those of a range that have no record, in a pool of processes. Cases that share a beginning are
/// run from there, in one process that forks.
class MissingCases {
 public:
  struct Options {
    campaign::CaseRange range;
    std::size_t jobs = 1;
    ProgressStyle progress = ProgressStyle::Auto;
  };

  /// All but the options must outlive it.
  MissingCases(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
               const campaign::CaseFolder& cases, const campaign::CaseScratch& scratch,
               const Options& options);

  /// Until all are there, or the user interrupts it.
  void run();

  const campaign::CaseTotals& totals() const { return totals_; }
  static bool is_interrupted();

 private:
  campaign::CaseTotals totals_before();
  bool is_done_elsewhere(std::uint64_t index);
  void run_some(const std::vector<std::uint64_t>& cases);
  void start(std::uint64_t index);
  void start_together(campaign::SharedBeginning shared, std::size_t jobs);
  void run_doubtful();
  void await_room();
  void collect();
  void conclude(const CasePool::Ended& ended);
  void count_shared();
  void end_together(std::uint64_t first);

  const campaign::Plan& plan_;
  const campaign::CampaignScenario& scenario_;
  const campaign::CaseFolder& cases_;
  const Options options_;
  const isolation::ChildOptions child_options_;
  const CaseRunner runner_;
  CasePool pool_;
  std::vector<bool> is_done_;  ///< from the first of the range on
  /// What runs in one process, by the first case; of the cases those without a record.
  std::map<std::uint64_t, campaign::SharedBeginning> together_;
  std::deque<std::uint64_t> left_over_;  ///< by such processes
  std::vector<std::uint64_t> doubtful_;  ///< see CaseRunner::is_doubtful()
  campaign::CaseTotals totals_;
  CampaignProgress progress_;
};

}  // namespace stride::cli

#endif
