// What all parts of one run share.
#ifndef STRIDE_MASTER_ALGORITHM_RUN_CONTEXT_H
#define STRIDE_MASTER_ALGORITHM_RUN_CONTEXT_H

#include <memory>
#include <vector>

#include "master/algorithm/exchange/exchange.h"
#include "master/algorithm/exchange/system_outputs.h"
#include "master/algorithm/observer.h"
#include "master/algorithm/run_options.h"
#include "master/algorithm/statistics.h"
#include "master/algorithm/unit.h"
#include "master/model/system.h"
#include "master/util/wall_clock.h"

namespace stride::core {

/// Owned by the run and passed to each of its parts, which keep references to the members that they
/// use. It must outlive them.
struct RunContext {
  /// `units` in the order of system.components(). The system must outlive the context.
  RunContext(const System& system, std::vector<std::unique_ptr<Unit>> units, RunOptions options);
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  const System& system;
  const std::vector<std::unique_ptr<Unit>> units;
  const RunOptions options;
  const std::vector<VariableId>
      observed;  ///< recorded and watched variables, sorted, without duplicates
  SystemOutputs outputs;
  Exchange exchange;
  RunStatistics statistics;
  std::vector<Observer*> observers;
  Activities activities;
  Time until;       ///< no step goes beyond it
  WallClock clock;  ///< measures in some of the communication steps only (TimeSampling)
};

}  // namespace stride::core

#endif
