// Where a unit puts the files that it writes itself.
#ifndef STRIDE_RESULTS_H
#define STRIDE_RESULTS_H

#include <cstdlib>
#include <filesystem>

namespace stride {

/// The unit's own folder among the run's results, if the importer has set the environment variable
/// STRIDE_RESULTS, as `stride run` does; else the working folder. To be called while the unit is
/// instantiated, and kept: later the variable may name the folder of another unit in this process.
/// A unit made with the kit has the folder in its Setup (<stride/unit.h>).
inline std::filesystem::path results_folder() {
  const char* const folder = std::getenv("STRIDE_RESULTS");
  return folder != nullptr ? folder : std::filesystem::current_path();
}

}  // namespace stride

#endif
