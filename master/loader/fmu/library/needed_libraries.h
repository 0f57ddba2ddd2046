// The libraries that a unit's needs, before it is loaded.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_NEEDED_LIBRARIES_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_NEEDED_LIBRARIES_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "master/loader/fmu/library/library_file.h"

namespace stride::importer {

struct NeededLibrary {
  std::string name;            ///< by which it is needed
  std::filesystem::path file;  ///< empty if there is none
  /// The one that the unit brings along; empty if the loader would not come to it, either.
  std::filesystem::path bundled;
  bool is_loaded = false;  ///< one of the name is in this process already: `file`
  DynamicPart part{};      ///< of `bundled`, else of `file`

  /// Whether another one than the unit brings along has its name in this process, which has one of
  /// a name.
  bool is_displaced() const;
};

/// A unit's library and those that it needs, each file read once.
struct UnitLibraries {
  std::filesystem::path file;
  DynamicPart part{};
  /// In the loader's order, each once; and those that they need in turn, unless they are loaded for
  /// others. Without what comes with the compilers of C, C++ and Fortran.
  std::vector<NeededLibrary> needed{};
};
UnitLibraries read_libraries(const std::filesystem::path& unit);

/// Whether this name of a file, "libm.so.6", is that of a library which comes with the compilers.
bool is_of_compiler(std::string_view name);

/// The libraries that a unit's library needs, for as long as it is in use.
class LibraryUse {
 public:
  explicit LibraryUse(const UnitLibraries& libraries);
  ~LibraryUse();
  LibraryUse(const LibraryUse&) = delete;
  LibraryUse& operator=(const LibraryUse&) = delete;

  /// Whether one of them may be in the process for longer than the unit, of which it may then hold
  /// objects and functions: it was there before, it stays, or another unit needs it as well.
  bool may_be_outlived() const;

 private:
  struct Used {
    std::filesystem::path file;
    bool may_outlive = false;  ///< whichever units need it
  };
  std::filesystem::path unit_;
  std::vector<Used> used_;  ///< those that may keep something of a unit
};

}  // namespace stride::importer

#endif
