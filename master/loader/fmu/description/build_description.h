// What the sources of an FMU are compiled from.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_BUILD_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_BUILD_DESCRIPTION_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/engine/model/description.h"

namespace stride::importer {

/// Files that are compiled with the same settings.
struct SourceFileSet {
  std::string language{};  ///< "C99", "C++11"; empty = by the names of the files
  std::vector<std::filesystem::path> files{};     ///< within the folder 'sources'
  std::vector<std::string> definitions{};         ///< "NAME" or "NAME=value", for the preprocessor
  std::vector<std::filesystem::path> includes{};  ///< folders, likewise
  std::vector<std::string> options{};             ///< for the compiler
};

struct BuildDescription {
  std::vector<SourceFileSet> sets{};
  std::vector<std::string> libraries{};  ///< of the system, by their names for the linker
  std::vector<std::string> warnings{};
};

/// Of the FMU with this model description, and its sources beside it: the
/// sources/buildDescription.xml of FMI 3.0, in which the configuration for this platform counts, or
/// one for any; the <SourceFiles> of FMI 2.0. Throws core::Error (Input) for what is malformed, for
/// names that lead out of the folder 'sources', and if there are no sources for Co-Simulation.
BuildDescription read_build_description(const std::filesystem::path& model_description,
                                        const core::UnitDescription& unit);

}  // namespace stride::importer

#endif
