// The steps of a run and of its components.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_RUN_STEPS_H
#define STRIDE_MASTER_SYSTEM_PLAN_RUN_STEPS_H

#include <cstddef>
#include <span>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/time/grid.h"
#include "master/engine/run/context/run_options.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/plan/resolved_system.h"
#include "master/system/plan/run_times.h"
#include "master/system/scenario/units/unit_log.h"

namespace stride::scenario {

/// Sets what the scenario and the request, which takes precedence, say of the stepping, and returns
/// the steps of components that keep their own. Throws core::Error (Input) for sizes that
/// contradict each other or a unit.
ComponentSteps choose_steps(const ResolvedSystem& resolved, const StepSettings& request,
                            const PlannedTimes& times, core::RunOptions& options);

/// Where regular steps end.
class StepGrids {
 public:
  /// Both outlive it.
  StepGrids(std::span<const core::ComponentDeclaration> components, const core::RunOptions& options)
      : components_(components), options_(options) {}

  core::Interval step_of(std::size_t component) const {
    return components_[component].own_step.value_or(options_.step.size);
  }
  core::Grid grid_of(std::size_t component) const { return {options_.start, step_of(component)}; }
  /// That of the run.
  core::Grid grid() const { return {options_.start, options_.step.size}; }

 private:
  std::span<const core::ComponentDeclaration> components_;
  const core::RunOptions& options_;
};

/// Warns of steps that units may not be made for, and returns when the run stops: with the last
/// whole step of units that take steps of one size only. Throws core::Error (Input) where there is
/// none, and for a policy that does not fit the system.
Time check_steps(const core::System& system, const ResolvedSystem& resolved, bool has_stop,
                 const core::RunOptions& options, UnitLog& log);

/// Of units that take steps of one size only and whose step is another one than they declare: some
/// count their steps, and not the time.
void warn_of_other_steps(const ResolvedSystem& resolved, const core::RunOptions& options,
                         UnitLog& log);

}  // namespace stride::scenario

#endif
