// Units of stride that become a unit of their own with a file in their resources.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FILE_UNITS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FILE_UNITS_H

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/fmu/pack.h"

namespace stride::scenario {

/// Whether the file holds stimuli written by --capture, or a table of values over time (.csv,
/// .parquet, .mcap).
bool is_stimuli(const std::filesystem::path& path);
/// Whether it is such a table.
bool is_table(const std::filesystem::path& path);
/// The unit player with this file in its resources. Returns warnings. Throws core::Error.
std::vector<std::string> pack_stimuli(const importer::PackRequest& request);

/// The unit in a file: that of an FMU or a library, or the unit player of stimuli and tables.
/// Throws core::Error (Input); `shown_as` is the path in messages, if that is another one.
std::shared_ptr<importer::Fmu> load_unit(const std::filesystem::path& path,
                                         const core::Location& where = {},
                                         const std::filesystem::path& shown_as = {});

/// Whether the file is meant to be the declaration of a program.
bool is_program(const std::filesystem::path& path);
/// The unit process with this declaration and the files that it names in its resources. Returns
/// warnings. Throws core::Error.
std::vector<std::string> pack_program(const importer::PackRequest& request);

}  // namespace stride::scenario

#endif
