// Where a unit puts the files that it writes itself.
#ifndef STRIDE_RESULTS_H
#define STRIDE_RESULTS_H

#include <cstdlib>
#include <filesystem>

namespace stride {

/// The folder of the run's other results, if the importer has set the environment variable
/// STRIDE_RESULTS, as `stride run` does; else where the program was started.
inline std::filesystem::path results_folder() {
  const char* const folder = std::getenv("STRIDE_RESULTS");
  return folder != nullptr ? folder : std::filesystem::current_path();
}

}  // namespace stride

#endif
