// A scenario: an SSP system file (.ssd), read and checked as far as it goes without its units.
#ifndef STRIDE_MASTER_IO_SCENARIO_H
#define STRIDE_MASTER_IO_SCENARIO_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/core/system.h"
#include "master/io/annotation.h"

namespace stride::io {

struct Scenario {
  std::filesystem::path path;
  std::string name;         ///< of the system structure description
  std::string ssp_version;  ///< "1.0" or "2.0"
  /// Its components have no description yet. Values bound to the system stand behind those bound to
  /// its components, so they replace them, as SSP wants it.
  core::SystemDeclaration system;
  /// The FMU of each of system.components: relative to the working directory or absolute.
  std::vector<std::filesystem::path> sources;
  std::optional<Time> start;  ///< of the DefaultExperiment
  std::optional<Time> stop;
  ScenarioAnnotation annotation;
};

/// Reads a .ssd of SSP 1.0 or 2.0 and the .ssv files that it names. Throws core::Error (Input) with
/// file and line for what is missing, malformed or unknown, and for those parts of SSP that stride
/// does not support: nothing is passed over, except what has no influence on a simulation
/// (geometry, graphics, meta data, other tools' annotations).
Scenario read_scenario(const std::filesystem::path& path);

}  // namespace stride::io

#endif
