// What a checkpoint of a run holds, beside the states of units.
#ifndef STRIDE_MASTER_STUDY_RESULTS_CHECKPOINT_STATES_H
#define STRIDE_MASTER_STUDY_RESULTS_CHECKPOINT_STATES_H

#include <algorithm>
#include <cstddef>
#include <string>

#include "master/base/state_archive.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/simulation.h"
#include "master/observe/checkpoint/checkpoint_file.h"

namespace stride::results {

/// The state of all but units and observers.
inline constexpr const char* kSimulation = "simulation";

/// How many interventions have begun by then.
inline std::size_t interventions_until(const core::RunOptions& options, Time time) {
  return static_cast<std::size_t>(std::ranges::count_if(
      options.interventions,
      [&](const core::Intervention& intervention) { return intervention.from <= time; }));
}

/// Calls go(state, started), which is Simulation::begin() or resume(), with the state of the
/// checkpoint. Throws core::BadState where it is another one than it says.
template <class Go, class Started>
void go_on_from(const checkpoint::Checkpoint& checkpoint, const core::Simulation& simulation,
                Go&& go, Started&& started) {
  core::StateArchive state(checkpoint::state_of(checkpoint, kSimulation));
  go(state, [&] {
    state.end();
    if (simulation.statistics().reached != checkpoint.time) {
      throw core::BadState("its state is of another time than it says");
    }
    started();
  });
}

/// Of an object with persist().
template <class Object>
void add_state(checkpoint::Checkpoint& checkpoint, const std::string& name, Object& object) {
  core::StateArchive state;
  object.persist(state);
  checkpoint.states[name] = state.bytes();
}

/// Throws core::BadState where it is none of the object.
template <class Object>
void restore_state(const checkpoint::Checkpoint& checkpoint, const std::string& name,
                   Object& object) {
  core::StateArchive state(checkpoint::state_of(checkpoint, name));
  object.persist(state);
  state.end();
}

}  // namespace stride::results

#endif
