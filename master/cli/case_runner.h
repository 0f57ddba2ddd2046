// Runs cases of a campaign and judges how they have ended.
#ifndef STRIDE_MASTER_CLI_CASE_RUNNER_H
#define STRIDE_MASTER_CLI_CASE_RUNNER_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "master/campaign/campaign_scenario.h"
#include "master/campaign/case_folder.h"
#include "master/campaign/case_record.h"
#include "master/campaign/plan.h"
#include "master/campaign/shared_beginnings.h"
#include "master/cli/case_pool.h"
#include "master/cli/case_run.h"

namespace stride::cli {

/// What all cases have in common. The arguments must outlive it.
class CaseRunner {
 public:
  /// Reads the files of the scenario into memory, so that all cases have what the plan was made of.
  CaseRunner(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
             const campaign::CaseScratch& scratch);

  /// In a process of its own: what is to be handed to conclude(); empty if it was interrupted.
  std::string run(std::uint64_t index) const;

  /// In a process of its own: what these cases share, and from there each of them in a process of
  /// its own, `jobs` at a time, with its record. A case without a record behind it, for whatever
  /// reason, has to be run alone. Returns nothing.
  std::string run_together(const campaign::SharedBeginning& shared, std::size_t jobs,
                           const isolation::ChildOptions& options) const;

  /// In the process that has started it: puts results and record in their places. Nothing, and no
  /// record, if the case was interrupted. Throws core::Error (Run) if the disk does not take them.
  std::optional<campaign::CaseResult> conclude(const CasePool::Ended& ended) const;

 private:
  scenario::ScenarioRequest request(std::uint64_t index) const;
  CaseResults results(std::uint64_t index) const;
  bool has_hosts() const;
  campaign::CaseResult simulate(std::uint64_t index, bool& was_interrupted) const;
  std::string simulate_rest(std::uint64_t index, const campaign::SharedBeginning& shared,
                            CaseRun& run) const;
  std::optional<campaign::CaseResult> result_of(const CasePool::Ended& ended) const;
  void complete_results(std::uint64_t index, const campaign::CaseResult& result) const;
  std::string with_lasting_paths(std::uint64_t index, std::string text) const;

  const campaign::Plan& plan_;
  const campaign::CampaignScenario& scenario_;
  const campaign::CaseScratch& scratch_;
  mutable core::FileDigests digests_;
};

}  // namespace stride::cli

#endif
