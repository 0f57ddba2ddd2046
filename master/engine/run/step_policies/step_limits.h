// What bounds the steps of a run, whatever its policy.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_LIMITS_H
#define STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_LIMITS_H

#include <optional>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/time/grid.h"
#include "master/engine/run/context/run_options.h"

namespace stride::core {

/// The span of the run, the longest step that the user and the units allow, and the units' fixed
/// internal steps.
class StepLimits {
 public:
  /// `default_maximum` applies where the user gives none.
  StepLimits(const System& system, const RunOptions& options,
             std::optional<Interval> default_maximum = std::nullopt);

  Time start() const { return start_; }
  Time stop() const { return stop_; }
  /// Nothing: neither the user nor a unit limits the steps.
  std::optional<Duration> maximum() const { return maximum_; }
  /// Whether steps of this size would be too long; less than a picosecond does not count.
  bool are_below(const Interval& size) const { return maximum_ && *maximum_ < size.rounded(); }
  /// A common multiple of all fixed internal steps; 1 ps where there are none.
  Interval quantum() const { return quantum_ ? quantum_->step() : Interval(Duration(1)); }

  /// The target, or the end of the longest step where that is nearer.
  Time limited(Time now, Time target) const {
    return maximum_ && target - now > *maximum_ ? now + *maximum_ : target;
  }
  /// The end of a step of this size, at most the stop time, rounded down to a multiple of the
  /// quantum. If that gives no progress it is rounded up, unless the step would exceed the maximum;
  /// then it is not rounded.
  Time end_of_step(Time now, Duration size) const;

 private:
  void refine_quantum(const Interval& internal);

  Time start_;
  Time stop_;
  std::optional<Duration> maximum_;
  std::optional<Grid> quantum_;
};

}  // namespace stride::core

#endif
