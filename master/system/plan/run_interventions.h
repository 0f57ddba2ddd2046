// The interventions of a run.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_RUN_INTERVENTIONS_H
#define STRIDE_MASTER_SYSTEM_PLAN_RUN_INTERVENTIONS_H

#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/intervention.h"
#include "master/engine/run/context/run_options.h"
#include "master/system/declaration/interventions.h"
#include "master/system/plan/request.h"
#include "master/system/plan/resolved_system.h"

namespace stride::scenario {

/// What interventions have to fit.
struct InterventionScope {
  const ResolvedSystem& resolved;
  const core::System& system;
  const core::RunOptions& options;  ///< with start and steps
  Time latest{};                    ///< at which one may begin
  std::string stop_hint{};          ///< see PlannedTimes
};

/// Those of the command line and its branches, beside the scenario's. `alone`: see Scenario.
std::vector<InterventionDeclaration> requested_interventions(const core::System& system,
                                                             const std::string& alone,
                                                             const ScenarioRequest& request);

/// Those of the scenario and these, in the order of their instants. Throws core::Error (Input) as
/// resolve_interventions() does, and where one is within a step of a unit that takes steps of one
/// size only.
std::vector<core::Intervention> resolve_interventions(const InterventionScope& scope,
                                                      std::vector<InterventionDeclaration> further);

/// What changes a unit changes its twin.
void add_interventions_of_twins(std::span<const IdleTwin> twins,
                                std::vector<core::Intervention>& interventions);

}  // namespace stride::scenario

#endif
