#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_UNIT_PATH_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_UNIT_PATH_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/base/error.h"

namespace stride::scenario {

/// The folders that are searched for units: those in the environment variable STRIDE_UNITS
/// (separated by colons), and those beside the program, ../units of a build and
/// ../lib/stride/units of an installation.
std::vector<std::filesystem::path> unit_folders();

/// The path itself if it exists, else the file of that name in the first unit folder that has it.
/// Throws core::Error (Input) that lists the searched folders, with the nearest name there and
/// beside the path.
std::filesystem::path find_unit(const std::filesystem::path& path, const core::Location& where);
/// Likewise; errors name the path `shown_as`.
std::filesystem::path find_unit_shown_as(const std::filesystem::path& path,
                                         const std::string& shown_as, const core::Location& where);

}  // namespace stride::scenario

#endif
