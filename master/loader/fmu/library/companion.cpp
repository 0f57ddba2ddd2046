#include "master/loader/fmu/library/companion.h"

#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <link.h>

#include "master/base/files/input_file.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// Whether one is the other, or has more of a version: "libx.so.1.2", "libx.so.1", "libx.so".
bool differ_by_version(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return a.find(".so") != a.npos && b.starts_with(a) && b.substr(a.size()).starts_with('.');
}

/// The only one in the folder.
fs::path find_other_version(const fs::path& folder, const std::string& name) {
  fs::path found;
  for (const fs::path& file : core::folder_entries(folder)) {
    if (!differ_by_version(file.filename().string(), name) || !core::is_file(file)) continue;
    if (!found.empty()) return {};
    found = file;
  }
  return found;
}

/// At any depth, in the order of their names; not all of what is no FMU but a disk.
void append_folders_below(const fs::path& top, std::vector<fs::path>& folders) {
  constexpr std::size_t kMostFolders = 1000;
  if (folders.size() > kMostFolders) return;
  for (const fs::path& entry : core::folder_entries(top)) {
    std::error_code ignored;
    if (!core::is_folder(entry) || fs::is_symlink(entry, ignored)) continue;
    folders.push_back(entry);
    append_folders_below(entry, folders);
  }
}

}  // namespace

fs::path find_companion(const fs::path& library, const std::string& name) {
  const fs::path folder = library.parent_path();
  const fs::path binaries = folder.parent_path();
  const std::string plain = fs::path(name).filename().string();
  std::vector<fs::path> folders{folder};
  if (binaries.filename() == "binaries") {
    const fs::path resources = binaries.parent_path() / "resources";
    append_folders_below(folder, folders);
    folders.insert(folders.end(), {binaries, resources, resources / folder.filename()});
  }
  for (const fs::path& candidate : folders) {
    if (core::is_file(candidate / plain)) return candidate / plain;
  }
  for (const fs::path& candidate : folders) {
    fs::path found = find_other_version(candidate, plain);
    if (!found.empty() && found != library) return found;
  }
  return {};
}

std::vector<std::string> find_namesakes(const fs::path& library, const std::string& name) {
  const fs::path binaries = library.parent_path().parent_path();
  if (binaries.filename() != "binaries") return {};
  const fs::path fmu = binaries.parent_path();
  const std::string plain = fs::path(name).filename().string();
  std::vector<fs::path> folders{fmu};
  append_folders_below(fmu, folders);
  std::vector<std::string> found;
  for (const fs::path& folder : folders) {
    if (!core::is_file(folder / plain)) continue;
    found.push_back((folder / plain).lexically_relative(fmu).string());
  }
  return found;
}

LoaderName::LoaderName(void* handle, std::string name) : name_(std::move(name)) {
  link_map* loaded = nullptr;
  if (::dlinfo(handle, RTLD_DI_LINKMAP, &loaded) != 0 || loaded == nullptr) return;
  place_ = &loaded->l_name;  // which the loader compares with the names that it looks for
  before_ = std::exchange(*place_, name_.data());
}

LoaderName::~LoaderName() {
  if (place_ != nullptr) *place_ = before_;
}

}  // namespace stride::importer
