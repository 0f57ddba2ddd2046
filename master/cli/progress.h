#ifndef STRIDE_MASTER_CLI_PROGRESS_H
#define STRIDE_MASTER_CLI_PROGRESS_H

#include <chrono>

#include "master/core/observer.h"

namespace stride::cli {

/// Shows how far a run is, on the standard error stream: one line that is rewritten on a terminal,
/// a plain line for each tenth elsewhere.
class Progress : public core::Observer {
 public:
  Progress(Time start, Time stop);

  void on_start(std::span<const core::Signal> signals) override;
  void on_communication_point(Time time) override;
  void on_finish() override;

 private:
  using Clock = std::chrono::steady_clock;

  void show(Time time, Clock::time_point now) const;

  Time start_;
  Time stop_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point began_{};
  Clock::time_point next_redraw_{};
  Time next_line_{};
  Time last_{};
};

}  // namespace stride::cli

#endif
