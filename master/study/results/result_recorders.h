// The recorders of the result files that are written.
#ifndef STRIDE_MASTER_STUDY_RESULTS_RESULT_RECORDERS_H
#define STRIDE_MASTER_STUDY_RESULTS_RESULT_RECORDERS_H

#include <optional>

#include "master/engine/model/system/system.h"
#include "master/engine/run/simulation.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/recorders/activity_recorder.h"
#include "master/observe/recorders/csv_recorder.h"
#include "master/observe/recorders/event_recorder.h"
#include "master/observe/recorders/vcd_recorder.h"
#include "master/study/results/results_target.h"

namespace stride::results {

/// How the files of a run begin.
enum class Beginning {
  Empty,
  Kept,            ///< with what a run has left that goes on
  KeptButSignals,  ///< likewise, but for those of the signals, which are others now
};

class ResultRecorders {
 public:
  /// Creates the files, or opens them. Throws core::Error.
  ResultRecorders(const core::System& system, Time stop, const ResultsTarget& target,
                  Beginning beginning);

  void add_to(core::Simulation& simulation);
  void add_to(checkpoint::Checkpoint& checkpoint);
  /// Compares the files that were left.
  void restore(const checkpoint::Checkpoint& checkpoint);
  /// Behind restore().
  void go_on();
  /// Before a fork, and in it.
  void flush();
  void continue_in_copies(const ResultsTarget& target);

 private:
  /// Calls `visit` with the name, the recorder and the member of ResultFiles of each that there is.
  template <class Visit>
  void visit(Visit&& visit);

  std::optional<recorders::CsvRecorder> signals_;
  std::optional<recorders::EventRecorder> events_;
  std::optional<recorders::VcdRecorder> trace_;
  std::optional<recorders::ActivityRecorder> activity_;
};

}  // namespace stride::results

#endif
