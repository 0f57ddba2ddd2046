#include "master/loader/fmu/library/needed_libraries.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include <dlfcn.h>
#include <link.h>

#include "master/base/files/input_file.h"
#include "master/loader/fmu/library/companion.h"
#include "master/loader/fmu/library/loaded_image.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// Where the loader looks after all else, and those that its cache mostly adds.
constexpr std::array kSystemFolders {
#if defined(__x86_64__)
  "/lib/x86_64-linux-gnu", "/usr/lib/x86_64-linux-gnu", "/lib64", "/usr/lib64",
#elif defined(__aarch64__)
  "/lib/aarch64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/lib64", "/usr/lib64",
#endif
      "/lib", "/usr/lib", "/usr/local/lib"
};

/// "libm" of "libm.so.6".
std::string_view plain_name(std::string_view name) {
  name = name.substr(name.rfind('/') + 1);
  return name.substr(0, name.find(".so"));
}

/// Whether the library keeps no object and no function of those that call it beyond the life of
/// what they made of it. Of those that stride itself is linked with, and that units are, too.
bool keeps_nothing(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames{"libfmt", "libmd", "libtinyxml2", "libz"};
  return std::ranges::count(kNames, plain_name(name)) > 0;
}

/// The file of this library in the process; empty if it is not there.
fs::path loaded_file(const std::string& name) {
  void* const handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return {};
  link_map* place = nullptr;
  const bool is_found = ::dlinfo(handle, RTLD_DI_LINKMAP, &place) == 0;
  fs::path file = is_found ? place->l_name : "";
  ::dlclose(handle);
  return file;
}

/// $ORIGIN is the folder of the library that names the folder.
fs::path with_origin(std::string folder, const fs::path& library) {
  for (const std::string_view word : {"$ORIGIN", "${ORIGIN}"}) {
    const std::size_t place = folder.find(word);
    if (place != std::string::npos) {
      folder.replace(place, word.size(), library.parent_path().string());
    }
  }
  return folder;
}

/// As the loader does.
std::vector<fs::path> folders_for(const fs::path& library,
                                  const std::vector<std::string>& search_path) {
  std::vector<fs::path> folders;
  for (const std::string& folder : search_path) folders.push_back(with_origin(folder, library));
  const char* const named = std::getenv("LD_LIBRARY_PATH");
  std::istringstream further(named != nullptr ? named : "");
  for (std::string folder; std::getline(further, folder, ':');) folders.emplace_back(folder);
  folders.insert(folders.end(), kSystemFolders.begin(), kSystemFolders.end());
  return folders;
}

/// Where the loader comes to it; empty if it does not.
fs::path find_on_path(const std::string& name, const fs::path& library,
                      const std::vector<std::string>& search_path) {
  if (name.find('/') != std::string::npos) return core::is_file(name) ? fs::path(name) : "";
  for (const fs::path& folder : folders_for(library, search_path)) {
    if (core::is_file(folder / name)) return folder / name;
  }
  return {};
}

/// The folder of the FMU that has the unit's library, or the library's own.
fs::path folder_of_unit(const fs::path& unit) {
  const fs::path binaries = unit.parent_path().parent_path();
  return binaries.filename() == "binaries" ? binaries.parent_path() : unit.parent_path();
}

bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path inside = file.lexically_normal().lexically_relative(folder.lexically_normal());
  return !inside.empty() && *inside.begin() != "..";
}

/// `unit` is the library whose FMU may have it.
NeededLibrary find_needed(const std::string& name, const fs::path& library,
                          const std::vector<std::string>& search_path, const fs::path& unit) {
  NeededLibrary needed{name, loaded_file(name), find_on_path(name, library, search_path)};
  needed.is_loaded = !needed.file.empty();
  if (needed.bundled.empty()) {
    needed.bundled = find_companion(unit, name);
  } else if (!is_below(needed.bundled, folder_of_unit(unit))) {
    if (!needed.is_loaded) needed.file = needed.bundled;
    needed.bundled.clear();
  }
  if (!needed.is_loaded && !needed.bundled.empty()) needed.file = needed.bundled;
  needed.part = read_dynamic_part(needed.bundled.empty() ? needed.file : needed.bundled);
  return needed;
}

/// Which libraries are needed, and by which units.
class Uses {
 public:
  void add(const fs::path& library, const fs::path& unit) {
    const std::lock_guard lock(mutex_);
    units_[library].insert(unit);
  }
  void remove(const fs::path& library, const fs::path& unit) {
    const std::lock_guard lock(mutex_);
    auto& units = units_[library];
    units.erase(units.find(unit));
  }
  bool is_shared(const fs::path& library, const fs::path& unit) {
    const std::lock_guard lock(mutex_);
    const auto& units = units_[library];
    return units.size() > units.count(unit);
  }

 private:
  std::mutex mutex_;
  std::map<fs::path, std::multiset<fs::path>> units_;
};

/// Never destroyed, since units may be unloaded when the process ends.
Uses& uses() {
  static auto& uses = *new Uses;
  return uses;
}

}  // namespace

bool NeededLibrary::is_displaced() const {
  return is_loaded && !bundled.empty() && !is_loaded_from_equal(name, bundled);
}

UnitLibraries read_libraries(const fs::path& unit) {
  UnitLibraries libraries{unit, read_dynamic_part(unit)};
  std::vector<NeededLibrary>& found = libraries.needed;
  // by value: `found` grows
  const auto add_needed_of = [&](const fs::path file, const std::vector<std::string> needed,
                                 const std::vector<std::string> search_path) {
    for (const std::string& name : needed) {
      const bool is_known = std::ranges::count(found, name, &NeededLibrary::name) > 0;
      if (is_known || is_of_compiler(name)) continue;
      found.push_back(find_needed(name, file, search_path, unit));
    }
  };
  add_needed_of(unit, libraries.part.needed, libraries.part.search_path);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].is_loaded && found[i].bundled.empty()) continue;
    add_needed_of(found[i].bundled.empty() ? found[i].file : found[i].bundled, found[i].part.needed,
                  found[i].part.search_path);
  }
  return libraries;
}

bool is_of_compiler(std::string_view name) {
  constexpr std::array<std::string_view, 19> kNames{
      "libc",   "libm",      "libstdc++", "libgcc_s",  "ld-linux", "libpthread",  "libdl",
      "librt",  "libutil",   "libresolv", "libatomic", "libgomp",  "libgfortran", "libquadmath",
      "libc++", "libc++abi", "libasan",   "libubsan",  "libtsan"};
  const std::string_view plain = plain_name(name);
  return plain.starts_with("ld-linux") || std::ranges::count(kNames, plain) > 0;
}

LibraryUse::LibraryUse(const UnitLibraries& libraries) : unit_(libraries.file) {
  for (const NeededLibrary& library : libraries.needed) {
    if (keeps_nothing(library.name)) continue;
    used_.push_back({library.file, library.is_loaded || library.part.stays_loaded});
  }
  for (const Used& library : used_) uses().add(library.file, unit_);
}

LibraryUse::~LibraryUse() {
  for (const Used& library : used_) uses().remove(library.file, unit_);
}

bool LibraryUse::may_be_outlived() const {
  return std::ranges::any_of(used_, [this](const Used& library) {
    return library.may_outlive || uses().is_shared(library.file, unit_);
  });
}

}  // namespace stride::importer
