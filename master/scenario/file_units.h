// Units that stride brings along, packed with a file that makes them a unit of its own.
#ifndef STRIDE_MASTER_SCENARIO_FILE_UNITS_H
#define STRIDE_MASTER_SCENARIO_FILE_UNITS_H

#include <filesystem>

#include "master/importer/pack.h"

namespace stride::cli {

/// Whether it holds stimuli that --capture has written.
bool is_stimuli(const std::filesystem::path& path);
/// The unit player with this file in its resources. Throws core::Error.
void pack_stimuli(const fmi::PackRequest& request);

/// Whether it is to be the declaration of a program.
bool is_program(const std::filesystem::path& path);
/// The unit process with this declaration and the files that it names in its resources. Throws
/// core::Error.
void pack_program(const fmi::PackRequest& request);

}  // namespace stride::cli

#endif
