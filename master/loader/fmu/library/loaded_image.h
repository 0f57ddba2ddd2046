// Libraries of one name, of which a process has one.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_LOADED_IMAGE_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_LOADED_IMAGE_H

#include <filesystem>
#include <string>

namespace stride::importer {

/// Whether the library of this name that is in the process is from such a file. If its own has been
/// removed meanwhile, the code and the constants are compared. True where there is none of the
/// name.
bool is_loaded_from_equal(const std::string& name, const std::filesystem::path& file);

}  // namespace stride::importer

#endif
