// From a resolved system to the plan of a run.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_RUN_PLAN_H
#define STRIDE_MASTER_SYSTEM_PLAN_RUN_PLAN_H

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/process/process_state.h"
#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"
#include "master/loader/fmu/fmu.h"
#include "master/observe/checks/definition.h"
#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/demand.h"
#include "master/system/plan/declared.h"
#include "master/system/plan/request.h"
#include "master/system/plan/resolved_system.h"
#include "master/system/plan/run_interventions.h"
#include "master/system/scenario/coverage_selection.h"
#include "master/system/scenario/hosting.h"
#include "master/system/scenario/signal_selection.h"
#include "master/system/scenario/units/unit_log.h"

namespace stride::scenario {

/// What runs, where, with which settings, and what is recorded of it. Nothing of it changes.
class RunPlan {
 public:
  /// Throws core::Error (Input) for every mistake.
  RunPlan(ResolvedSystem resolved, const ScenarioRequest& request);
  /// Through all stages: declare(), resolve() and this one.
  explicit RunPlan(const ScenarioRequest& request);

  const Scenario& scenario() const { return resolved_.scenario; }
  const core::System& system() const { return system_; }
  /// In the order of system().components().
  const std::vector<std::shared_ptr<importer::Fmu>>& fmus() const { return resolved_.fmus; }
  /// Likewise; empty for a component without a host.
  const std::vector<std::optional<Hosting>>& hostings() const { return hostings_; }
  /// Whether the unit of a component is one of another machine, of which nothing but its
  /// description is known here.
  bool stays_elsewhere(std::size_t component) const;
  const core::RunOptions& options() const { return options_; }
  /// Whether a stop time is known, without which a run cannot begin.
  bool has_stop() const { return has_stop_; }
  const ScenarioChanges& changes() const { return changes_; }
  std::vector<std::string> component_names() const {
    return scenario::component_names(resolved_.scenario.system);
  }
  /// Those that were requested.
  const std::vector<IdleTwin>& idle_twins() const { return resolved_.idle_twins; }
  /// The plots of the scenario, of recorded signals.
  const std::vector<recorders::Plot>& plots() const { return plots_; }
  /// The checks of the scenario; options() watch their signals.
  const std::vector<checks::Definition>& checks() const { return checks_; }
  /// The coverage of the scenario and of the request; options() watch its signals.
  const std::vector<coverage::GroupDefinition>& coverage() const { return coverage_.groups; }
  /// Checks of it.
  const std::vector<coverage::Demand>& demands() const { return coverage_.demands; }

  /// The interventions of the scenario and these, in the order of their instants, as options()
  /// would have them. Throws core::Error (Input) as the constructor does.
  std::vector<core::Intervention> resolve(std::vector<InterventionDeclaration> further) const;
  /// Those of a future of the run that begins at this instant, beside the scenario's and the
  /// command line's. Throws core::Error (Input) as resolve_interventions() does, also for one that
  /// begins earlier.
  std::vector<core::Intervention> interventions_of_branch(
      std::span<const InterventionDeclaration> declarations, Time begin) const;

  /// Warns of units that take steps of one size only and whose step is another one than they
  /// declare. Behind a run: one that fails for that reason says so in its error.
  void warn_of_other_steps() const;

  /// As it was before the first unit was loaded.
  const std::shared_ptr<const core::ProcessState>& process() const { return process_; }
  /// To which the messages of units go.
  const std::shared_ptr<UnitLog>& log() const { return log_; }

 private:
  void choose_hosts(const HostRequest& request);
  void choose_idle_skips(const ScenarioRequest& request);
  void choose_interventions(const ScenarioRequest& request);
  void choose_signals(const ScenarioRequest& request);
  void choose_checks(const ScenarioRequest& request);
  void choose_coverage(const ScenarioRequest& request);
  void check_demand_names() const;
  InterventionScope intervention_scope() const;

  std::shared_ptr<UnitLog> log_ = std::make_shared<UnitLog>();
  std::shared_ptr<const core::ProcessState> process_ = std::make_shared<core::ProcessState>();
  ScenarioChanges changes_;
  ResolvedSystem resolved_;
  core::System system_;
  std::vector<std::optional<Hosting>> hostings_;
  core::RunOptions options_;
  bool has_stop_ = true;
  std::string stop_hint_;  ///< see PlannedTimes
  Time latest_intervention_{};
  std::vector<recorders::Plot> plots_;
  std::vector<checks::Definition> checks_;
  SelectedCoverage coverage_;
  std::vector<InterventionDeclaration> further_interventions_;  ///< than the scenario's
};

}  // namespace stride::scenario

#endif
