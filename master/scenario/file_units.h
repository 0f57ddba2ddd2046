// Units of stride that become a unit of their own with a file in their resources.
#ifndef STRIDE_MASTER_SCENARIO_FILE_UNITS_H
#define STRIDE_MASTER_SCENARIO_FILE_UNITS_H

#include <filesystem>

#include "master/importer/pack.h"

namespace stride::scenario {

/// Whether the file holds stimuli written by --capture.
bool is_stimuli(const std::filesystem::path& path);
/// The unit player with this file in its resources. Throws core::Error.
void pack_stimuli(const importer::PackRequest& request);

/// Whether the file is meant to be the declaration of a program.
bool is_program(const std::filesystem::path& path);
/// The unit process with this declaration and the files that it names in its resources. Throws
/// core::Error.
void pack_program(const importer::PackRequest& request);

}  // namespace stride::scenario

#endif
