// The states of objects in a checkpoint.
#ifndef STRIDE_MASTER_RESULTS_CHECKPOINT_STATES_H
#define STRIDE_MASTER_RESULTS_CHECKPOINT_STATES_H

#include <string>

#include "master/checkpoint/checkpoint_file.h"
#include "master/util/state_archive.h"

namespace stride::results {

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
