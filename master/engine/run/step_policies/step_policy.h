// The choice of communication points.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_POLICY_H
#define STRIDE_MASTER_ENGINE_RUN_STEP_POLICIES_STEP_POLICY_H

#include <memory>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"

namespace stride::core {

struct ExtrapolationError;
class Grid;
class StateArchive;

/// Chooses the communication points of one run. No step is longer than a unit allows
/// (maximum_step). Steps that are not on a grid end on the units' fixed internal steps, as far as
/// events and maxima allow.
class StepPolicy {
 public:
  virtual ~StepPolicy() = default;

  /// The next communication point: later than `now`, and the stop time at most. The same one
  /// however often it is asked for at `now`.
  virtual Time next(Time now) = 0;

  /// Likewise, where no unit has to be called before `quiet_until`. A policy with a grid goes on to
  /// the last point of the grid that is not later than that.
  virtual Time next_while_idle(Time now, Time /*quiet_until*/) { return next(now); }

  /// Where the next steps end, if nothing but the stop time cuts one of them short: the points of a
  /// grid that `now` is one of. Or else null.
  virtual const Grid* regular_grid(Time /*now*/) const { return nullptr; }

  /// Whether the step is accepted. If not, it is undone, and next() chooses a nearer point. Called
  /// where StepPolicyType::controls_error only. Throws Error (Run) where no shorter step is
  /// allowed.
  virtual bool accept(Time /*from*/, Time /*reached*/, const ExtrapolationError& /*error*/) {
    return true;
  }

  /// What it goes by beside the time.
  virtual void persist(StateArchive& /*state*/) {}
};

/// Throws Error (Input) where a unit does not fulfil what the policy of the options requires: steps
/// of various sizes, and with StepPolicyType::controls_error that steps can be undone. Throws
/// std::invalid_argument for a step size that is not positive.
void check_step_policy(const System& system, const RunOptions& options);

/// The policy of the options. The system must outlive it. Throws as check_step_policy() does.
std::unique_ptr<StepPolicy> make_step_policy(const System& system, const RunOptions& options);

}  // namespace stride::core

#endif
