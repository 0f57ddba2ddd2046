// The units of a run whose state can be kept.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNALS_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNALS_H

#include <memory>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/port/unit.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/checkpoint/journaled_unit.h"

namespace stride::checkpoint {

/// Call order: wrap(), then restore() for a run that goes on, and add_to() at communication points.
class Journals {
 public:
  /// The system must outlive this object and the units.
  explicit Journals(const core::System& system) : system_(system) {}

  /// Puts a JournaledUnit around each of them. `stop`: of this run.
  void wrap(std::vector<std::unique_ptr<core::Unit>>& units, Time stop);
  /// Makes the units what those of the checkpoint were. Throws core::BadState for states of other
  /// units, and core::Error (Run) where a unit fails or does not repeat what it did.
  void restore(const Checkpoint& checkpoint);
  void add_to(Checkpoint& checkpoint);

 private:
  const core::System& system_;
  std::vector<JournaledUnit*> units_;  ///< in the order of the components
};

}  // namespace stride::checkpoint

#endif
