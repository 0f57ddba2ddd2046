// The end of a step that a unit makes in a thread of its own.
#ifndef STRIDE_MASTER_LOADER_FMU_FMI2_ASYNCHRONOUS_STEP_H
#define STRIDE_MASTER_LOADER_FMU_FMI2_ASYNCHRONOUS_STEP_H

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "master/loader/fmu/library/status.h"

namespace stride::importer {

/// Where a unit's callback stepFinished reports how a step ended, on whatever thread, before
/// fmi2DoStep returns or after it, and even after a poll has found the same.
class AsynchronousStep {
 public:
  /// Before fmi2DoStep is called.
  void begin();
  /// A poll has found how the step ended, so a callback that has not come yet is not the next
  /// step's.
  void note_polled();
  void finish(Status status) noexcept;
  /// The step's status, as soon as it is known; nothing if that takes longer.
  std::optional<Status> wait(std::chrono::microseconds time);

 private:
  std::mutex mutex_;
  std::condition_variable is_finished_;
  std::optional<Status> status_;
  unsigned late_ = 0;  ///< callbacks of earlier steps that have not come yet
};

}  // namespace stride::importer

#endif
