// What the command line wants of a scenario.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_REQUEST_H
#define STRIDE_MASTER_SYSTEM_PLAN_REQUEST_H

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "master/loader/fmu/fmu.h"
#include "master/system/declaration/interventions.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/scenario/branches.h"
#include "master/system/scenario/hosting.h"
#include "master/system/ssp/files.h"
#include "master/system/ssp/parameters.h"

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

}  // namespace stride::scenario

#endif
