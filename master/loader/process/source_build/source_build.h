// A unit's library from its sources.
#ifndef STRIDE_MASTER_LOADER_PROCESS_SOURCE_BUILD_SOURCE_BUILD_H
#define STRIDE_MASTER_LOADER_PROCESS_SOURCE_BUILD_SOURCE_BUILD_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/loader/fmu/description/build_description.h"

namespace stride::isolation {

struct SourceBuild {
  importer::BuildDescription description;
  std::filesystem::path sources;                  ///< the folder that its names are in
  std::vector<std::string> definitions{};         ///< "NAME" or "NAME=value", which come last
  std::vector<std::filesystem::path> includes{};  ///< further folders with headers
  std::filesystem::path folder;   ///< for objects; what is compiled may write nowhere else
  std::filesystem::path library;  ///< the result, in that folder
};

/// Compiles and links with the C and C++ compilers that the environment variables CC and CXX name,
/// else `cc` and `c++`, in a process in the sandbox. FMI's headers are found, also where the FMU
/// has none; functions are exported without a prefix. Throws core::Error (Input), with what the
/// compiler printed, where something does not compile or link, and (Run) if there is no compiler.
void build_library(const SourceBuild& build);

}  // namespace stride::isolation

#endif
