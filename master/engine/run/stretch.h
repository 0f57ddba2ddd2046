// Communication steps between which there is nothing to do.
#ifndef STRIDE_MASTER_ENGINE_RUN_STRETCH_H
#define STRIDE_MASTER_ENGINE_RUN_STRETCH_H

#include <csignal>
#include <cstdint>
#include <optional>

#include <stride/time.h>

#include "master/engine/model/time/grid.h"
#include "master/engine/run/context/run_context.h"
#include "master/engine/run/events/event_handler.h"
#include "master/engine/run/events/interventions.h"
#include "master/engine/run/pauses.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/engine/run/stepping/stepper.h"
#include "master/engine/run/time_sampling.h"

namespace stride::core {

/// Successive communication steps of one size, between which values are exchanged and observers are
/// called, but no event, clock, message, intervention, pause or reading of a wall clock is due.
/// What makes it so is looked at before them, and not in each. All that comes of them is what would
/// come of the same steps one by one.
class Stretch {
 public:
  struct Parts {
    StepPolicy& policy;
    EventHandler& event_handler;
    Interventions& interventions;
    Pauses& pauses;
    Stepper& stepper;
    TimeSampling& sampling;
  };

  /// All must outlive this object. `is_possible`: whether inputs keep their values during a step,
  /// and no unit may be suspended.
  Stretch(RunContext& context, const Parts& parts, bool is_possible);

  /// How many steps can be made so from a communication point on that has been observed. Mostly
  /// known at once where it is none.
  std::uint64_t steps_from(Time now) const;

  /// Makes so many steps from `time` on, which follows, as long as they are plain and the run is
  /// not interrupted. If a unit stops a step or requests something in it, this is the last one, and
  /// still to be concluded: returns the time that all units have reached with it.
  std::optional<Time> make(Time& time, std::uint64_t steps);

 private:
  bool is_interrupted() const { return interrupted_ != nullptr && *interrupted_ != 0; }
  Time free_until() const;
  template <class Walk>
  std::optional<Time> walk(Walk next, double size_seconds, Time& time, std::uint64_t steps);
  void observe(const Time& time);

  RunContext& context_;
  const Parts parts_;
  const bool is_possible_;
  const Duration size_;  ///< of a step, to the picosecond
  const volatile std::sig_atomic_t* interrupted_;
};

}  // namespace stride::core

#endif
