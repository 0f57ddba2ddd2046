// The libraries that a unit's needs, before it is loaded.
#ifndef STRIDE_MASTER_IMPORTER_NEEDED_LIBRARIES_H
#define STRIDE_MASTER_IMPORTER_NEEDED_LIBRARIES_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride::importer {

struct NeededLibrary {
  std::string name;            ///< by which it is needed
  std::filesystem::path file;  ///< empty if there is none
  bool is_loaded = false;      ///< it is in this process already
  bool stays_loaded = false;   ///< once it is in this process
};

/// Those that the library needs, in the loader's order, each once; and those that they need in
/// turn, unless they are loaded. Without what comes with the compilers of C, C++ and Fortran.
std::vector<NeededLibrary> needed_libraries(const std::filesystem::path& library);

/// Whether this name of a file, "libm.so.6", is that of a library which comes with the compilers.
bool is_of_compiler(std::string_view name);

/// The libraries that a unit's library needs, for as long as it is in use.
class LibraryUse {
 public:
  LibraryUse(std::filesystem::path unit, std::vector<NeededLibrary> needed);
  ~LibraryUse();
  LibraryUse(const LibraryUse&) = delete;
  LibraryUse& operator=(const LibraryUse&) = delete;

  const std::vector<NeededLibrary>& needed() const { return needed_; }

  /// Whether one of them may be in the process for longer than the unit, of which it may then hold
  /// objects and functions: it was there before, it stays, or another unit needs it as well.
  bool may_be_outlived() const;

 private:
  std::filesystem::path unit_;
  std::vector<NeededLibrary> needed_;
};

}  // namespace stride::importer

#endif
