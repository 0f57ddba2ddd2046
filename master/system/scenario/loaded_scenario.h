// A scenario with its units, ready to run.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_LOADED_SCENARIO_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_LOADED_SCENARIO_H

#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/base/process/process_state.h"
#include "master/engine/model/system/known_names.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/time/grid.h"
#include "master/engine/run/simulation.h"
#include "master/loader/fmu/fmu.h"
#include "master/observe/checks/definition.h"
#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/demand.h"
#include "master/system/declaration/interventions.h"
#include "master/system/declaration/scenario.h"
#include "master/system/scenario/branches.h"
#include "master/system/scenario/coverage_selection.h"
#include "master/system/scenario/hosting.h"
#include "master/system/scenario/idle_twins.h"
#include "master/system/scenario/signal_selection.h"
#include "master/system/scenario/units/unit_log.h"

namespace stride::scenario {

/// Units that are loaded, by their paths: scenarios that are loaded with the same ones have them in
/// common.
using UnitStore = std::map<std::filesystem::path, std::shared_ptr<importer::Fmu>>;

/// The settings of the command line for a scenario.
struct ScenarioRequest {
  std::filesystem::path scenario;
  std::vector<std::string> swaps;                      ///< "component=FILE"
  std::vector<ssp::ParameterValue> parameters;         ///< start values, which `sets` replace
  std::vector<std::filesystem::path> parameter_files;  ///< from which these are, if from files
  std::vector<std::string> sets;                       ///< "component.variable=value"
  std::vector<std::string> set_at;                     ///< "component.variable=value@time"
  std::vector<std::string> forces;       ///< "component.variable[=value]@from..[until]"
  std::vector<std::string> drops;        ///< "component.variable@from..[until]"
  std::vector<std::string> delays;       ///< "component.variable=seconds@from..[until]"
  std::vector<std::string> corruptions;  ///< "component.variable[=bits]@from..[until]"
  std::vector<InterventionDeclaration> interventions;  ///< further ones
  std::vector<BranchReference> branches;               ///< whose interventions are added
  std::vector<std::string> signals;                    ///< globs that replace the scenario's
  std::string start;                                   ///< seconds; empty = the scenario's
  std::string stop;                                    ///< likewise
  bool may_lack_stop = false;                          ///< for what runs nothing: see has_stop()
  StepSettings step;                                   ///< overrides the scenario
  bool no_idle_skip = false;
  std::string max_skip;  ///< seconds, for all components; empty = the scenario's
  bool no_checks = false;
  bool no_coverage = false;           ///< nor checks of it
  std::vector<std::string> coverage;  ///< components that get a group of automatic points
  bool idle_twins = false;            ///< adds them, see idle_twins.h
  HostRequest hosts;
  std::shared_ptr<ssp::Files> files;  ///< that have read some of it ahead; null: none
  std::shared_ptr<UnitStore> units;   ///< to which those that are not there are added; null: none
  std::string film;   ///< seconds between its pictures, or kUnspecifiedInterval; empty = none
  std::string scene;  ///< likewise between its poses
};

/// What a request changes in the scenario as it is written.
struct ScenarioChanges {
  std::vector<std::string> swaps;                      ///< "component=FILE"
  std::vector<std::string> values;                     ///< at the start, "component.variable=value"
  std::vector<std::filesystem::path> parameter_files;  ///< with some of these values
};

/// The scenario with each component's FMU, and the system built from them. Throws core::Error
/// (Input) for every mistake in the input.
class LoadedScenario {
 public:
  explicit LoadedScenario(const ScenarioRequest& request);

  const Scenario& scenario() const { return scenario_; }
  const core::System& system() const { return *system_; }
  /// In the order of system().components().
  const std::vector<std::shared_ptr<importer::Fmu>>& fmus() const { return fmus_; }
  /// Likewise; empty for a component without a host.
  const std::vector<std::optional<Hosting>>& hostings() const { return hostings_; }
  /// Whether the unit of a component is one of another machine, of which nothing but its
  /// description is known here.
  bool stays_elsewhere(std::size_t component) const;
  const core::RunOptions& options() const { return options_; }
  /// Whether a stop time is known, without which a run cannot begin.
  bool has_stop() const { return has_stop_; }
  const ScenarioChanges& changes() const { return changes_; }
  std::vector<std::string> component_names() const;
  /// Those that were requested.
  const std::vector<IdleTwin>& idle_twins() const { return idle_twins_; }
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
  const core::ProcessState& process() const { return *process_; }

  /// Fresh instances in the order of system().components(). Their messages go to the log. The units
  /// write their files to their folders in `results`, which exist (recorders::UnitFolders), and
  /// hosted ones nowhere else; if it is empty, there are none. `interrupted` is set to another
  /// value than 0 to end a wait for a unit; null = nothing is.
  std::vector<std::unique_ptr<core::Unit>> instantiate(
      const std::filesystem::path& results = {},
      const volatile std::sig_atomic_t* interrupted = nullptr) const;

 private:
  /// For mistakes that concern the scenario as a whole.
  core::Context of_file() const;
  void load_units(const ScenarioRequest& request);
  void connect_terminals();
  void add_twins();
  std::vector<std::string> selection_names() const;
  void choose_early_returns();
  void choose_state_saving();
  void choose_repeated_steps();
  std::vector<bool> permissions(std::span<const PermissionRule> rules) const;
  void choose_times(const ScenarioRequest& request);
  Time chosen_start(const ScenarioRequest& request) const;
  Time earliest_start_of_units() const;
  Time chosen_stop(const ScenarioRequest& request) const;
  std::optional<Time> declared_stop() const;
  Duration declared_length() const;
  void choose_steps(const StepSettings& request);
  ComponentSteps set_component_steps(const StepSettings& request) const;
  void choose_component_steps(const ComponentSteps& set, bool is_size_set);
  void check_internal_step(const core::ComponentDeclaration& component) const;
  void warn_of_early_returns(const core::ComponentDeclaration& component) const;
  core::Interval step_of(std::size_t component) const;
  core::Grid grid_of(std::size_t component) const;
  void choose_checks(const ScenarioRequest& request);
  void choose_coverage(const ScenarioRequest& request);
  void check_demand_names() const;
  void choose_hosts(const HostRequest& request);
  void check_steps();
  void choose_idle_skips(const ScenarioRequest& request);
  void choose_interventions(const ScenarioRequest& request);
  core::Grid grid() const;
  void check_instants(std::span<const core::Intervention> interventions) const;
  void check_instants(std::size_t component, const core::Intervention& intervention) const;
  void choose_signals(const ScenarioRequest& request);
  void warn_of_many_steps() const;
  void end_with_whole_steps();
  void warn_of_last_own_steps() const;
  void warn_of_internal_steps() const;
  void warn_of_unlimited_steps() const;
  importer::InstanceOptions instance_options(std::size_t component,
                                             const std::filesystem::path& results,
                                             const volatile std::sig_atomic_t* interrupted) const;

  std::shared_ptr<UnitLog> log_ = std::make_shared<UnitLog>();
  std::shared_ptr<const core::ProcessState> process_ = std::make_shared<core::ProcessState>();
  ScenarioChanges changes_;
  Scenario scenario_;
  std::vector<std::shared_ptr<importer::Fmu>> fmus_;
  std::optional<core::System> system_;
  std::vector<std::optional<Hosting>> hostings_;
  core::RunOptions options_;
  bool has_stop_ = true;
  Time latest_intervention_{};
  std::vector<recorders::Plot> plots_;
  std::vector<checks::Definition> checks_;
  SelectedCoverage coverage_;
  std::vector<IdleTwin> idle_twins_;
  std::vector<InterventionDeclaration> further_interventions_;  ///< than the scenario's
};

/// The two sides of an option's value "NAME=VALUE", see core::KnownNames::split(). Throws
/// core::Error (Input) with the expected `form`.
std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text,
                                                 const std::string& form,
                                                 const core::KnownNames& names);

/// The sides of "COMPONENT=FILE".
struct ComponentFile {
  std::string component;
  std::filesystem::path file;
};

/// Nothing if a side is missing. Throws core::Error (Input) for what can be meant in two ways.
std::optional<ComponentFile> split_component_file(const std::string& option,
                                                  const std::string& text,
                                                  const core::KnownNames& names);
/// Likewise, where the file is there.
std::optional<ComponentFile> split_existing_file(const std::string& option,
                                                 const std::string& text);
/// Likewise of an option; throws core::Error (Input) with the expected `form`.
ComponentFile component_file(const std::string& option, const std::string& text,
                             const std::string& form, const core::KnownNames& names);

/// The FMUs of a scenario's components, in their order; for `complete`, which needs no system. Of
/// units on other machines these are descriptions.
std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario);
/// Likewise, with those that are there already; others are added. `hosts`: of each component.
std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario, UnitStore& units,
                                                      std::span<const HostSettings> hosts);

}  // namespace stride::scenario

#endif
