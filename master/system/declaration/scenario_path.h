#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_SCENARIO_PATH_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_SCENARIO_PATH_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stride::scenario {

/// Where the scenarios that come with stride are, NAME/NAME.ssd: ../share/stride/scenarios beside
/// the program, of a build or an installation. It need not exist.
std::filesystem::path scenario_folder();

/// Their names, sorted.
std::vector<std::string> scenario_names(const std::filesystem::path& folder = scenario_folder());

/// The file of the scenario of that name in the folder, if there is one. A name has no folder and
/// no ending, and leads to nothing as a path: a file or folder of the user comes first.
std::optional<std::filesystem::path> named_scenario(
    const std::filesystem::path& name, const std::filesystem::path& folder = scenario_folder());

/// Throws core::Error (Input), with the nearest names, for a path at which nothing is and that
/// looks like a name.
void refuse_unknown_name(const std::filesystem::path& path,
                         const std::filesystem::path& folder = scenario_folder());

}  // namespace stride::scenario

#endif
