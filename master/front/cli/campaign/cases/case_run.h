// A run of a case of a campaign, in its own process.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_RUN_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_RUN_H

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "master/base/process/spare_files.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/run/recorded_run.h"
#include "master/front/cli/run/test_report.h"
#include "master/observe/capture/capture.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/definition/aggregates.h"
#include "master/study/campaign/definition/definition.h"
#include "master/system/plan/run_plan.h"

namespace stride::cli {

/// Which results a case writes beside its record.
struct CaseResults {
  std::filesystem::path folder;         ///< empty: none; otherwise it is made
  bool has_report = false;              ///< else only a case that does not pass has one
  recorders::Command command{};         ///< that repeats it
  core::FileDigests& digests;           ///< of the files that it is made from
  std::filesystem::path stimuli{};      ///< where those of `captured` go; it is made
  std::vector<std::string> captured{};  ///< components
};

/// Prints nothing but warnings.
class CaseRun {
 public:
  /// Throws core::Error (Input) as RunPlan does.
  CaseRun(const scenario::ScenarioRequest& request,
          const std::vector<campaign::Aggregate>& aggregates, const CaseResults& results);

  /// To its end, be it good or not.
  campaign::CaseResult run();
  /// Before run().
  void set_control(core::RunControl& control) { recorded_.set_control(control); }
  /// In a pause, before the process is forked: whether it can be.
  bool prepare_rest();
  /// In a fork of the process, in place of what follows the pause: with these interventions, of
  /// which none begins before that instant, and with results of its own.
  campaign::CaseResult run_rest(std::span<const scenario::InterventionDeclaration> interventions,
                                Time from, const CaseResults& results);
  /// Then the result is none.
  bool was_interrupted() const;

  /// In place of the end of run(): as RecordedRun::abandon().
  void abandon(const std::string& error) { recorded_.abandon(error); }

 private:
  /// The units end before it, and their libraries after it.
  struct EndOfUnits {
    const core::ProcessState& process;
    ~EndOfUnits();
  };

  static recorders::Provenance provenance(const CaseResults& results,
                                          const scenario::RunPlan& loaded);
  static results::ResultsTarget target_of(const CaseResults& results,
                                          const scenario::RunPlan& loaded);
  core::RunOptions run_options() const;
  capture::Capture capture_of(const CaseResults& results) const;
  std::vector<std::unique_ptr<core::Unit>> instantiate();
  template <class Go>
  campaign::CaseResult result_of(Go&& go);

  const core::SpareFiles spare_;
  const Interruption interruption_;
  const scenario::RunPlan loaded_;
  results::ResultsTarget target_;
  recorders::Provenance provenance_;
  campaign::Aggregates aggregates_;
  core::RunOptions options_;
  capture::Capture capture_;
  TestReport no_tests_{{}, {}};
  const std::unique_ptr<const recorders::UnitFolders> unit_folders_;  ///< null: none
  const EndOfUnits end_{*loaded_.process()};
  const RunDisplay display_{.progress = ProgressStyle::None, .quiet = true};
  RecordedRun recorded_;
};

}  // namespace stride::cli

#endif
