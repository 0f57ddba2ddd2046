// The files that the declaration of a program names, for the unit process.
#ifndef STRIDE_MASTER_SCENARIO_PROGRAM_FILES_H
#define STRIDE_MASTER_SCENARIO_PROGRAM_FILES_H

#include <filesystem>
#include <map>
#include <string>

namespace stride::io {

struct ProgramFiles {
  /// Those to be packed: name in the resources -> where it is.
  std::map<std::string, std::filesystem::path> packed;
  bool has_outside = false;  ///< others stay where they are
};

/// Reads as much of the declaration (docs/process-protocol.md) as is needed to pack it: all
/// attributes `file`, which are relative to it; each stands under its last name in the resources.
/// Throws core::Error (Input) with the line for a file that is not there, and for two of one name.
ProgramFiles program_files(const std::filesystem::path& declaration);

}  // namespace stride::io

#endif
