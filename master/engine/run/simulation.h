// A run: the stepping algorithm over a system and its instances.
#ifndef STRIDE_MASTER_ENGINE_RUN_SIMULATION_H
#define STRIDE_MASTER_ENGINE_RUN_SIMULATION_H

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"
#include "master/engine/port/observer.h"
#include "master/engine/port/unit.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/context/statistics.h"
#include "master/engine/run/events/sent_message.h"
#include "master/engine/run/run_control.h"
#include "master/engine/run/verdict.h"

namespace stride::core {

class StateArchive;

/// What a caller changes between two steps.
struct ChangesAtInstant {
  std::vector<Intervention> sets{};           ///< of the kind Set, at this instant
  std::vector<SentMessage> messages{};        ///< at most one to each clock
  std::vector<Intervention> interventions{};  ///< that begin now or later
};

/// Runs a system once. The pseudocode is in docs/stepping.md.
class Simulation {
 public:
  /// `units` are the instances in the order of system.components(). The system must outlive the
  /// simulation, the observers the run.
  Simulation(const System& system, std::vector<std::unique_ptr<Unit>> units, RunOptions options);
  ~Simulation();

  void add_observer(Observer& observer);
  /// The observer receives these signals, in this order, instead of the recorded ones. Each is one
  /// of RunOptions::recorded or RunOptions::watched.
  void add_observer(Observer& observer, std::vector<VariableId> signals);

  /// Before the run, which it must outlive.
  void set_control(RunControl& control);

  /// From initialisation to the stop time, or until a unit ends the simulation or it is
  /// interrupted. Then terminates and frees the units. Throws Error; the observers' on_finish() has
  /// been called then, and the statistics are those up to the failure.
  void run();

  /// Instead of run(): goes on from a state that persist() has written, of a run of the same system
  /// with the same options but for a later stop time, other interventions that begin behind the
  /// state's time, other recorded and watched variables, threads and what is measured. The units
  /// are in Step Mode, what they were where the state was written; no function of theirs is called
  /// that the uninterrupted run would not have called, except that variables which were neither
  /// recorded nor watched are read. `started` is called when the observers have been started, and
  /// before the first step: what follows in the archive, such as their states, can be read there.
  /// Throws as run() does, and BadState where the bytes are no state of this system: the units have
  /// been terminated, and the observers' on_finish() has been called then, too.
  void resume(StateArchive& state, const std::function<void()>& started);

  /// In a pause or an interruption (RunControl), and between the parts of a run: writes the state
  /// of the run, but for what belongs to the units and to the observers.
  void persist(StateArchive& state);
  /// In a pause: further interventions, beside those of the options. They begin later than now.
  void add_interventions(std::vector<Intervention> interventions);

  /// In a pause, in a fork of the process: makes the rest of the run, as run() does. Of the paused
  /// call nothing may go on behind it.
  void run_rest();

  // ---- In parts, instead of run() ----
  //
  // Each of them throws as run() does, and the run is over then, as behind end().

  /// From initialisation to the first communication point, which is observed.
  void begin();
  /// Likewise from a state, as resume() does.
  void begin(StateArchive& state, const std::function<void()>& started);
  /// From a communication point to the one at `until`, at the stop time, or where a unit ends the
  /// simulation or it is interrupted. A step ends at `until` as it does at an event.
  void advance(Time until);
  /// Between the parts: what a caller changes at the instant that has been reached. Units handle it
  /// as an event at this instant, which is then observed again.
  void make_event(ChangesAtInstant changes);
  /// Between the parts: the present value of any variable. A suspended unit catches up if its
  /// variable is neither connected nor observed.
  ValueBlock value(VariableId id);
  /// Terminates and frees the units.
  void end();

  /// Calls the observers' on_finish(), and no unit, where run() cannot go on: for a process that a
  /// unit has damaged. The statistics are those up to there.
  void abandon() noexcept;

  const RunStatistics& statistics() const;
  /// The simulated time for which units have been suspended because they promised to be idle,
  /// summed over all units up to the current communication point. Unlike
  /// UnitStatistics::suspended_time it includes suspensions that still last. For observers, at a
  /// communication point; it reads the state of each unit that may be suspended.
  Duration suspended_time() const;
  /// For observers, at a communication point: whether the component has been suspended from an
  /// earlier point on, so that it receives nothing of what is here.
  bool was_suspended(std::size_t component) const;
  /// The units' verdicts at the end of the run; undecided until then, and where it failed or was
  /// interrupted.
  std::span<const Verdict> verdicts() const;

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace stride::core

#endif
