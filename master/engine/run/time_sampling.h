// Wall-clock times of a run, measured in a sample of its communication steps.
#ifndef STRIDE_MASTER_ENGINE_RUN_TIME_SAMPLING_H
#define STRIDE_MASTER_ENGINE_RUN_TIME_SAMPLING_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "master/base/wall_clock.h"
#include "master/engine/run/context/statistics.h"

namespace stride::core {

/// Chooses the communication steps in which the clock measures, so that its readings take less than
/// a hundredth of the run, and scales what was measured to all steps.
///
/// Blocks of successive steps have one measured step each, at a random place, so that nothing
/// periodic hides from it. A block has as many steps as the cost of a measured step demands, beside
/// the time of the others: one only where steps take long, and all times are exact then. The
/// variance of a sum is estimated from the differences of successive blocks (Wolter, Introduction
/// to Variance Estimation, 2007, chapter 8).
///
/// Which steps are measured has no effect but on times.
class TimeSampling {
 public:
  /// Both must outlive it. Times that the clock has not measured at all stay 0.
  TimeSampling(WallClock& clock, RunStatistics& statistics);

  /// The initialization is over, in which all was measured. Times from before a resumption are in
  /// the statistics, with their uncertainties.
  void begin();
  /// Around each communication step.
  void begin_step() {
    if (step_++ == measured_) [[unlikely]]
      clock_.measure(true);
  }
  void end_step() {
    if (clock_.measures()) [[unlikely]]
      end_measured_step();
    if (step_ == block_end_) [[unlikely]]
      end_block();
  }
  /// How many of the next steps need neither of the two, but pass_step().
  std::uint64_t unmeasured_steps() const {
    return std::min(measured_ < step_ ? block_end_ : measured_, block_end_ - 1) - step_;
  }
  void pass_step() { ++step_; }
  /// The times are those of the whole run from here on.
  void end() { scale(statistics_); }
  /// Likewise, those of a copy of the statistics.
  void scale(RunStatistics& copy) const;

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  /// One of the times of the statistics.
  struct Sampled {
    Nanoseconds* time;
    Nanoseconds* uncertainty;
  };
  struct Meter {
    Nanoseconds* time;     ///< as it was measured
    Nanoseconds before{};  ///< of it, up to the last measured step
    double sum = 0;        ///< [ns]
    double variance = 0;   ///< [ns²]
    double last = 0;       ///< what the last block has added to the sum
    bool has_last = false;
  };

  static std::vector<Sampled> sampled(RunStatistics& statistics);
  void begin_block();
  void end_measured_step();
  void end_block();

  WallClock& clock_;
  RunStatistics& statistics_;
  bool is_on_;
  std::vector<Meter> meters_;
  Nanoseconds reading_{};  ///< what the readings of a measured step take
  WallClock::Source::time_point block_began_{};
  std::uint64_t size_ = 1;      ///< of the present block [steps]
  std::uint64_t step_ = 0;      ///< that were begun
  std::uint64_t measured_ = 0;  ///< the step of the present block that is measured
  std::uint64_t block_end_ = 1;
  std::mt19937_64 random_;
};

}  // namespace stride::core

#endif
