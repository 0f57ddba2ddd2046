// A run with everything that records, checks and shows it.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_RECORDED_RUN_H
#define STRIDE_MASTER_FRONT_CLI_RUN_RECORDED_RUN_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/simulation.h"
#include "master/engine/run/verdict.h"
#include "master/front/cli/run/live/live_report.h"
#include "master/front/cli/run/live/real_time.h"
#include "master/front/cli/run/run_arguments.h"
#include "master/front/cli/run/summary.h"
#include "master/front/cli/run/test_report.h"
#include "master/front/cli/terminal/progress.h"
#include "master/observe/capture/capture.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/recorders/provenance.h"
#include "master/study/results/results_target.h"
#include "master/study/results/run_records.h"
#include "master/system/plan/run_plan.h"

namespace stride::cli {

struct RunDisplay {
  ProgressStyle progress = ProgressStyle::Auto;
  bool quiet = false;        ///< no summary
  bool open_report = false;  ///< in a browser, when the run is over, or when the live one is there
  std::optional<double>
      real_time{};             ///< simulated seconds in one of the wall clock; none: no limit
  LiveServer* live = nullptr;  ///< null: nobody looks on; must outlive the run
};

/// What a run is made from, and must outlive it.
struct RunSetup {
  const scenario::RunPlan& loaded;
  const core::RunOptions& options;
  const recorders::Provenance& provenance;
  const results::ResultsTarget& results;
  const RunDisplay& display;
  capture::Capture& capture;
  TestReport& test_report;
  const Resumption* resumption = nullptr;    ///< null: the run begins at its start
  const Checkpoints* checkpoints = nullptr;  ///< if there are any
};

/// One simulation with its recorders, checks, captures, summary, progress and reports.
class RecordedRun {
 public:
  /// `units` are the instances of the scenario, with the captured ones wrapped by the capture.
  RecordedRun(const RunSetup& setup, std::vector<std::unique_ptr<core::Unit>> units);

  /// Before the run, which it must outlive.
  void set_control(core::RunControl& control) { simulation_.set_control(control); }
  void add_observer(core::Observer& observer, std::vector<core::VariableId> signals) {
    simulation_.add_observer(observer, std::move(signals));
  }

  /// Throws core::Error (Run) if the run fails or is interrupted, and if a check or a verdict
  /// failed. Whatever happens, the results are complete up to the last communication point.
  void run();
  /// Instead of run(), for units that are what they were at the checkpoint. Throws core::Error
  /// (Input) also where the checkpoint does not suit; the results are then what they were.
  void resume();

  /// In a pause, before the process is forked: what is written so far is in the files.
  void flush();
  /// Instead of what follows a pause, in a fork of the process: the rest of the run, with these
  /// interventions. The results, whose target has changed, begin with copies of those before, and
  /// so do the captures, in the folder `stimuli`; there is no test report. Throws as run() does.
  void run_rest(std::vector<core::Intervention> interventions,
                const std::filesystem::path& stimuli);

  /// At a communication point: adds the states of all but the units.
  void add_to(checkpoint::Checkpoint& checkpoint);

  const core::RunStatistics& statistics() const { return simulation_.statistics(); }
  /// When it is over.
  const std::vector<core::Verdict>& verdicts() const { return records_.verdicts(); }
  /// At any time.
  coverage::Report coverage() const { return records_.coverage(); }
  /// Whether its results are its own: not before resume() has found that it can go on.
  bool has_begun() const { return has_begun_; }
  /// Why it has not come to its end, if it has not.
  const std::optional<std::string>& failure() const { return failure_; }

  /// Instead of the end of run(), which something has prevented: ends the records without calling
  /// any unit, and writes what contains the error.
  void abandon(const std::string& error);

 private:
  template <class Go>
  void execute(Go&& go);
  void restore();
  void restore_process() const;
  void conclude_failure(const std::string& error);
  void conclude();
  void announce() const;
  void add_live_report();
  void write_statistics(std::optional<std::string> error);
  void write_page() const;
  void tell_real_time() const;
  void print_summary() const;
  void require_end() const;
  void warn_of_verdicts() const;

  const RunSetup setup_;
  core::Simulation simulation_;
  bool has_test_report_ = true;
  bool has_begun_;  ///< or, before that: the results are still those of the run that is resumed
  results::RunRecords records_;
  std::optional<std::string> failure_{};
  Summary summary_;
  Progress progress_;
  std::optional<LiveReport> live_{};
  std::optional<RealTime> real_time_{};
};

}  // namespace stride::cli

#endif
