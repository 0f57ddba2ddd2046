#include "master/base/archive/displaced_file.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/files/loose_path.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

/// Not all, where it is none of an archive but a disk.
std::vector<fs::path> folders_in(const std::vector<fs::path>& folders) {
  constexpr std::size_t kMostFolders = 1000;
  std::vector<fs::path> found;
  for (const fs::path& folder : folders) {
    if (found.size() > kMostFolders) break;
    for (fs::path& entry : packed_entries(folder)) {
      if (core::is_folder(entry)) found.push_back(std::move(entry));
    }
  }
  return found;
}

}  // namespace

std::vector<fs::path> packed_entries(const fs::path& folder) {
  std::vector<fs::path> entries = core::folder_entries(folder);
  std::erase_if(entries, [](const fs::path& path) {
    const std::string name = path.filename().string();
    return name.starts_with('.') || name == "__MACOSX";
  });
  return entries;
}

std::vector<fs::path> find_files(const fs::path& folder, const std::string& name) {
  constexpr int kDeepest = 2;
  std::vector<fs::path> found;
  std::vector<fs::path> folders{folder};
  for (int depth = 0; depth <= kDeepest && found.empty(); ++depth) {
    for (const fs::path& candidate : folders) {
      if (auto file = core::find_loosely(candidate, name)) found.push_back(std::move(*file));
    }
    if (depth < kDeepest) folders = folders_in(folders);
  }
  return found;
}

std::string displaced_text(const std::string& shown_as, const std::string& name,
                           const fs::path& folder, const fs::path& file) {
  return fmt::format("'{}' has its {} as '{}'; expected at its top, by this name", shown_as, name,
                     file.lexically_relative(folder).string());
}

}  // namespace stride::archive
