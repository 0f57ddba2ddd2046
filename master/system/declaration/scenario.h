// A scenario: an SSP system file (.ssd), read and checked as far as it goes without its units.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_SCENARIO_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_SCENARIO_H

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/system/declaration/annotation.h"
#include "master/system/declaration/vendor_step.h"
#include "master/system/ssp/files.h"
#include "master/system/ssp/system_tree.h"

namespace stride::scenario {

struct Scenario {
  std::filesystem::path path;  ///< as it was given
  std::string name;            ///< of the system structure description
  std::string ssp_version;     ///< "1.0" or "2.0"
  std::string alone;           ///< the component of a unit without a system; empty: it is a system
  /// Made of components alone, see flatten.h, which have no description yet.
  core::SystemDeclaration system;
  /// The FMU of each of system.components: relative to the working directory or absolute.
  std::vector<std::filesystem::path> sources;
  std::optional<Time> start;  ///< of the DefaultExperiment
  std::optional<Time> stop;
  ScenarioAnnotation annotation;
  std::vector<std::string> warnings;      ///< of what is odd, but no mistake
  std::optional<VendorStep> vendor_step;  ///< of another tool
  std::shared_ptr<ssp::Files> files;      ///< holds the folders that packages are unpacked to
};

/// A name for the results of a scenario: that of its file, or of its folder.
std::string stem(const std::filesystem::path& scenario);

/// What a scenario is read with.
struct ReadOptions {
  ssp::UnitFinder find_unit{};                    ///< finds the FMUs that hold parameters
  std::vector<ssp::ParameterValue> parameters{};  ///< bound to the root system behind all others
  std::shared_ptr<ssp::Files> files{};            ///< that have read some of it ahead; null: none
  /// Further ones, whose names the scenario without them tells; null: none.
  std::function<std::vector<ssp::ParameterValue>(const Scenario&)> late_parameters{};
};

/// Reads a system of SSP 1.0 or 2.0: a .ssd, a package (.ssp), or the folder that one unpacks to;
/// and what it names, but for its FMUs. An FMU is a system with one component. Throws core::Error
/// (Input) with file and line for what is missing, malformed or unknown, and for those parts of SSP
/// that stride does not support: nothing is ignored, except what has no influence on a simulation
/// (geometry, graphics, meta data, other tools' annotations).
Scenario read_scenario(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace stride::scenario

#endif
