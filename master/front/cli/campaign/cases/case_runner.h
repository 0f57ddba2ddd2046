// Runs cases of a campaign and judges how they have ended.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_RUNNER_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_RUNNER_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "master/base/child_process/process_limits.h"
#include "master/base/files/file_stamps.h"
#include "master/front/cli/campaign/cases/case_pool.h"
#include "master/front/cli/campaign/cases/case_run.h"
#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"
#include "master/study/campaign/shared_beginnings.h"

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

  /// Whether it may have ended so for a reason that is not its own: the machine lacked something,
  /// which other cases may have taken, or somebody has ended its process. Then its results are
  /// dropped, and it is to be run once more, with no other one beside it, before it is concluded.
  bool is_doubtful(const CasePool::Ended& ended) const;

  /// In the process that has started it: puts results and record in their places. Nothing, and no
  /// record, if the case was interrupted. Throws core::Error (Run), and there is no record, if the
  /// case has not come to its end and the disk is full, the machine lacks something, or a file of
  /// the scenario is no longer what it was.
  std::optional<campaign::CaseResult> conclude(const CasePool::Ended& ended) const;

 private:
  scenario::ScenarioRequest request(std::uint64_t index) const;
  CaseResults results(std::uint64_t index) const;
  bool has_hosts() const;
  campaign::CaseResult simulate(std::uint64_t index, bool& was_interrupted) const;
  std::string simulate_rest(std::uint64_t index, const campaign::SharedBeginning& shared,
                            CaseRun& run) const;
  std::optional<campaign::CaseResult> result_of(const CasePool::Ended& ended) const;
  bool has_units_elsewhere() const;
  void require_circumstances(const CasePool::Ended& ended,
                             const campaign::CaseResult& result) const;
  [[noreturn]] static void fail_case(std::uint64_t index, const std::string& why,
                                     const std::string& because, const std::string& hint);
  void require_libraries(std::uint64_t index) const;
  void complete_results(std::uint64_t index, const campaign::CaseResult& result) const;
  void conclude_stimuli(std::uint64_t index, const campaign::CaseResult& result) const;
  std::string with_lasting_paths(std::uint64_t index, std::string text) const;

  const campaign::Plan& plan_;
  const campaign::CampaignScenario& scenario_;
  const campaign::CaseScratch& scratch_;
  mutable core::FileDigests digests_;
  core::FileStamps libraries_;  ///< which each case loads
  core::FileStamps files_;
  isolation::ProcessLimits limits_;
};

}  // namespace stride::cli

#endif
