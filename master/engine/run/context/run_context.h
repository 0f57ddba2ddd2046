// What all parts of one run share.
#ifndef STRIDE_MASTER_ENGINE_RUN_CONTEXT_RUN_CONTEXT_H
#define STRIDE_MASTER_ENGINE_RUN_CONTEXT_RUN_CONTEXT_H

#include <memory>
#include <vector>

#include "master/base/wall_clock.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"
#include "master/engine/port/unit.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/context/statistics.h"
#include "master/engine/run/exchange/exchange.h"
#include "master/engine/run/exchange/system_outputs.h"

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
