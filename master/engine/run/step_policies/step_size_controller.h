// The size of a step from the errors of the steps before it.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_SIZE_CONTROLLER_H
#define STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_SIZE_CONTROLLER_H

#include <stride/time.h>

namespace stride::core {

class StateArchive;

/// A PI controller (Hairer, Wanner, "Solving Ordinary Differential Equations II", IV.2; after
/// Gustafsson, 1988). The error of a step is given as its ratio to what is tolerated.
class StepSizeController {
 public:
  struct Range {
    Duration minimum, maximum;
  };

  /// `first`: the size of the first step. `order`: of the local error, in the step size.
  StepSizeController(Duration first, double order) : order_(order), size_(first) {}

  /// Of the next step.
  Duration size() const { return size_; }

  /// A step of the size `used` was accepted: `ratio` is 1 at most.
  void accept(Duration used, double ratio, const Range& range);
  /// A step of the size `used`, which is more than `least`, is undone: `ratio` is above 1.
  void reject(Duration used, double ratio, Duration least);

  void persist(StateArchive& state);

 private:
  double order_;
  Duration size_;
  double previous_ratio_ = 1;
  bool was_rejected_ = false;
};

}  // namespace stride::core

#endif
