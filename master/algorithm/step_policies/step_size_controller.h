// How far the next communication step goes, as far as no event ends it.
#ifndef STRIDE_MASTER_ALGORITHM_STEPPING_STEP_SIZE_CONTROLLER_H
#define STRIDE_MASTER_ALGORITHM_STEPPING_STEP_SIZE_CONTROLLER_H

#include <optional>

#include <stride/time.h>

#include "master/algorithm/run_options.h"
#include "master/algorithm/stepping/input_extrapolator.h"
#include "master/model/system.h"

namespace stride::core {

/// The step policy of a run. No step is longer than a unit says it can be (maximum_step). Steps
/// that are not on a grid end on the units' fixed internal steps, as far as events and maxima let.
class StepSizeController {
 public:
  /// Throws Error (Input) where a unit cannot do what the policy needs: steps of various sizes, and
  /// with ErrorControlled also to be rolled back.
  StepSizeController(const System& system, const RunOptions& options);

  /// The communication point to go to: later than `now`, and the stop time at most.
  Time next(Time now);

  /// Likewise, where nothing happens before `quiet_until`: as far as that, or the next regular
  /// point, which is a point of the grid where steps are on one.
  Time stride(Time now, Time quiet_until);

  bool controls_error() const { return options_.policy == StepPolicy::ErrorControlled; }

  /// Whether the step is good enough; next() goes accordingly less or more far. With
  /// ErrorControlled only. The size follows a PI controller (Hairer, Wanner, "Solving Ordinary
  /// Differential Equations II", IV.2; after Gustafsson, 1988). Throws Error (Run) where no shorter
  /// step is allowed.
  bool accept(Time from, Time reached, const Excess& excess);

 private:
  void refine_quantum(Duration internal);
  void check_units(const System& system) const;
  /// Back to the last point of the units' internal steps. Where that is no step at all, on to the
  /// next one, or if that is further than the maximum, the time itself.
  Time on_internal_grid(Time time, Time now) const;
  [[noreturn]] void fail_tolerance(Time from, Time reached, const Excess& excess) const;

  const System& system_;
  StepOptions options_;
  Time start_;
  Time stop_;
  Time grid_point_;                  ///< the last target, where steps are on a grid
  double order_;                     ///< of the local error, in the step size
  std::optional<Duration> maximum_;  ///< the user's and the units'
  Duration quantum_{1};              ///< a multiple of all fixed internal steps
  Duration size_;                    ///< of the next step, with ErrorControlled
  double previous_ratio_ = 1;
  bool was_rejected_ = false;
};

}  // namespace stride::core

#endif
