// Pauses of a run, at communication points.
#ifndef STRIDE_MASTER_ENGINE_RUN_RUN_CONTROL_H
#define STRIDE_MASTER_ENGINE_RUN_RUN_CONTROL_H

#include <optional>

#include <stride/time.h>

namespace stride::core {

/// An instant between two communication steps at which a run pauses: nothing is under way then.
struct Pause {
  Time time;
  /// false: at the first communication point at or behind `time`. true: at the first one from which
  /// the next step would reach `time`, or go beyond it, so that what begins at `time` can still be
  /// added (Simulation::add_interventions()).
  bool before = false;
};

/// Uses the pauses of a run, in the thread of the simulation. A pause changes neither the
/// communication points nor a result.
class RunControl {
 public:
  virtual ~RunControl() = default;

  /// The next pause, if there is one: asked when the run begins, or is resumed, and after each
  /// pause. One that is due already is at `now`, the communication point at which the run is; so
  /// there may be several at the same one. There is none behind the point at which a unit ends the
  /// run.
  virtual std::optional<Pause> next(Time now) = 0;
  /// The point has been observed. Simulation::persist() and add_interventions() may be called; the
  /// process may fork. What it throws ends the run.
  virtual void on_pause(Time now) = 0;
  /// The run was interrupted at this point (RunOptions::interrupted): the last occasion for
  /// Simulation::persist(). No unit is terminated yet.
  virtual void on_interruption(Time /*now*/) {}
};

}  // namespace stride::core

#endif
