// What a run leaves.
#ifndef STRIDE_MASTER_STUDY_RESULTS_RUN_RECORDS_H
#define STRIDE_MASTER_STUDY_RESULTS_RUN_RECORDS_H

#include <optional>
#include <string>
#include <vector>

#include "master/engine/run/context/intervention.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/simulation.h"
#include "master/engine/run/verdict.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/checks/checks.h"
#include "master/observe/coverage/coverage.h"
#include "master/observe/recorders/provenance.h"
#include "master/study/results/result_recorders.h"
#include "master/study/results/results_target.h"
#include "master/system/plan/run_plan.h"

namespace stride::results {

/// What records are made of, and must outlive them.
struct RecordedSubject {
  const scenario::RunPlan& loaded;
  const core::RunOptions& options;
  const recorders::Provenance& provenance;
  const ResultsTarget& target;
};

/// The recorders, checks and coverage of a simulation, and the files that say how it went.
class RunRecords {
 public:
  /// Adds its observers to the simulation, which must outlive it. Throws core::Error.
  RunRecords(const RecordedSubject& subject, core::Simulation& simulation, Beginning beginning);

  /// Writes a run.json of a run that is not over, so that one which ends without a word is not
  /// taken for none, or for a good one. Returns its path; empty if there is none yet.
  std::filesystem::path announce() const;

  /// At a communication point: adds the states of all of it.
  void add_to(checkpoint::Checkpoint& checkpoint);
  /// Throws core::BadState.
  void restore(const checkpoint::Checkpoint& checkpoint);
  /// Likewise, for files that begin where the checkpoint is.
  void restore_checks(const checkpoint::Checkpoint& checkpoint);

  /// In a pause, before the process is forked: what is written so far is in the files.
  void flush() { recorders_.flush(); }
  /// In a fork, whose target has changed: goes on in copies of the files, with these interventions.
  void continue_in_copies(std::vector<core::Intervention> further);

  /// When the run is over: those of the units, the checks and the coverage. `is_complete`: it has
  /// come to an end at which all that is demanded of it counts.
  void collect_verdicts(bool is_complete);
  const std::vector<core::Verdict>& verdicts() const { return verdicts_; }
  /// Whether it has ended as the scenario wants it to, and not by an earlier stop time.
  bool is_complete() const;

  /// At any time.
  coverage::Report coverage() const;
  bool has_coverage() const { return !coverage_.is_empty(); }

  /// coverage.json and run.json. Where one of the two cannot be written, the other one contains
  /// that, as `error` does then. Throws core::Error.
  void write_files(std::optional<std::string>& error) const;
  /// report.html; returns where it is, empty if there is none. Throws core::Error.
  std::filesystem::path write_page() const;

  /// Of what units did in a run that is over.
  void warn_of_units() const;

 private:
  void write_coverage_file() const;
  void write_run_file(const std::optional<std::string>& error, bool is_over) const;
  void warn_of_late_events() const;
  void warn_of_inexact_repetitions() const;

  const RecordedSubject subject_;
  core::Simulation& simulation_;
  ResultRecorders recorders_;
  checks::Checks checks_;
  coverage::Coverage coverage_;
  std::vector<core::Verdict> verdicts_;
  std::vector<core::Intervention> further_;  ///< interventions of continue_in_copies()
};

}  // namespace stride::results

#endif
