// The progress of a campaign, on the standard error stream.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CAMPAIGN_PROGRESS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CAMPAIGN_PROGRESS_H

#include <chrono>
#include <optional>
#include <string>

#include "master/front/cli/terminal/progress.h"
#include "master/study/campaign/evaluation/case_table.h"

namespace stride::cli {

/// Shows how many cases are done, how many of them have failed, and the time left at the mean speed
/// so far.
class CampaignProgress {
 public:
  /// `totals` has what was done before.
  CampaignProgress(ProgressStyle style, const campaign::CaseTotals& totals);

  /// `note` is for people, and follows the numbers.
  void show(const campaign::CaseTotals& totals, const std::string& note = "");
  /// No further case is run. `outcome` is for programs.
  void end(const campaign::CaseTotals& totals, const std::string& outcome);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due(const campaign::CaseTotals& totals, Clock::time_point now) const;
  std::optional<double> left(const campaign::CaseTotals& totals) const;
  void put(const campaign::CaseTotals& totals, const std::string* outcome,
           const std::string& note = "") const;
  void put_json(const campaign::CaseTotals& totals, const std::string* outcome) const;
  double elapsed() const;

  Progress::Form form_;
  std::uint64_t done_before_;
  std::uint64_t shown_tenth_;
  std::optional<std::uint64_t> shown_done_;  ///< by show()
  Clock::time_point began_ = Clock::now(), shown_ = began_;
};

}  // namespace stride::cli

#endif
