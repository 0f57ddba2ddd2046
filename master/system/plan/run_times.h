// When a run begins and ends.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_RUN_TIMES_H
#define STRIDE_MASTER_SYSTEM_PLAN_RUN_TIMES_H

#include <string>

#include <stride/time.h>

#include "master/system/plan/request.h"
#include "master/system/plan/resolved_system.h"

namespace stride::scenario {

struct PlannedTimes {
  Time start{};
  Time stop{};           ///< far away if none is known
  bool has_stop = true;  ///< whether one is known, without which a run cannot begin
  /// For times behind a stop time that only a unit has; else empty.
  std::string stop_hint{};
  /// As it is declared, or 0: it does not depend on --stop, so that a run that ends earlier, or is
  /// resumed to end later, makes the same steps.
  Duration declared_length{};
};

/// Those of the request, else of the scenario, else of the units. Throws core::Error (Input) for
/// times that contradict each other, and for a missing stop time that is not allowed to be missing.
PlannedTimes choose_times(const ResolvedSystem& resolved, const ScenarioRequest& request);

}  // namespace stride::scenario

#endif
