// The file of a shared library, before it is loaded.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_LIBRARY_FILE_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_LIBRARY_FILE_H

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace stride::importer {

/// Why the library must not be loaded: what its headers say would make the loader, which believes
/// them, overwrite memory of this process or read beyond the end of the file. Empty if nothing is
/// wrong with them, and for what the loader refuses itself: no ELF file, another machine.
std::string find_damage(const std::filesystem::path& library);

/// A name that the loader binds.
struct DynamicSymbol {
  std::string name;
  bool is_defined = false;  ///< by the library itself
  bool is_function = false;
  /// It exists once per process (STB_GNU_UNIQUE), such as a static variable of an inline function
  /// in C++: the first library that defines it has it for all others.
  bool is_unique = false;
};

/// What the loader reads of a library; empty if it is not one for this machine.
struct DynamicPart {
  std::vector<std::string> needed;       ///< names of libraries, in the loader's order
  std::vector<std::string> search_path;  ///< folders to look for them, $ORIGIN as it is written
  std::vector<DynamicSymbol> symbols;
  /// Where the file has the texts of all these names.
  std::uint64_t texts_begin = 0, texts_size = 0;
  /// It is never unloaded: it says so, or it defines symbols that exist once per process.
  bool stays_loaded = false;
  bool binds_to_itself = false;  ///< linked with -Bsymbolic
};
DynamicPart read_dynamic_part(const std::filesystem::path& library);

/// Makes these symbols, which exist once per process, ordinary ones of the library (STB_GLOBAL).
/// Throws std::filesystem::filesystem_error if the file cannot be written.
void make_ordinary(const std::filesystem::path& library, const std::set<std::string>& symbols);

/// The names of what it exports; none if it is no library for this machine.
std::set<std::string> exported_names(const std::filesystem::path& library);

}  // namespace stride::importer

#endif
