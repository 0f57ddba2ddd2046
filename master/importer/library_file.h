// The file of a shared library, before it is loaded.
#ifndef STRIDE_MASTER_IMPORTER_LIBRARY_FILE_H
#define STRIDE_MASTER_IMPORTER_LIBRARY_FILE_H

#include <filesystem>
#include <set>
#include <string>

namespace stride::importer {

/// Why the library must not be loaded: what its headers say would make the loader, which believes
/// them, overwrite memory of this process or read beyond the end of the file. Empty if nothing is
/// wrong with them, and for what the loader refuses itself: no ELF file, another machine.
std::string find_damage(const std::filesystem::path& library);

/// The names of what it exports; none if it is no library for this machine.
std::set<std::string> exported_names(const std::filesystem::path& library);

}  // namespace stride::importer

#endif
