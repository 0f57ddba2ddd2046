// What units say of a whole run.
#ifndef STRIDE_MASTER_CORE_VERDICT_H
#define STRIDE_MASTER_CORE_VERDICT_H

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/core/system.h"
#include "master/core/unit.h"

namespace stride::core {

/// A unit's verdict on a run that has ended well: whether it also was as it should be.
struct Verdict {
  std::size_t component = 0;
  bool passed = false;
  std::string text;  ///< why, for people; empty if the unit has no words for it
};

/// Those of the units that declare one, in the order of the components. The units, in that order,
/// stand at the end of the run, not terminated yet. Throws Error.
std::vector<Verdict> read_verdicts(const System& system,
                                   std::span<const std::unique_ptr<Unit>> units);

}  // namespace stride::core

#endif
