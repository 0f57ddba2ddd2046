#include "master/base/files/loose_path.h"

#include <string>
#include <vector>

#include "master/base/files/input_file.h"
#include "master/base/text/composed_letters.h"
#include "master/base/text/lower_case.h"

namespace stride::core {
namespace {

namespace fs = std::filesystem;

std::string loose(const fs::path& name) { return lower_case(composed(name.string())); }

std::optional<fs::path> find_name(const fs::path& folder, const fs::path& name) {
  if (path_exists(folder / name)) return folder / name;
  std::optional<fs::path> found;
  for (const fs::path& entry : folder_entries(folder)) {
    if (loose(entry.filename()) != loose(name)) continue;
    if (found) return std::nullopt;
    found = entry;
  }
  return found;
}

}  // namespace

std::optional<fs::path> find_loosely(const fs::path& folder, const fs::path& relative) {
  if (relative.is_absolute()) return std::nullopt;
  std::optional<fs::path> at = folder.empty() ? "." : folder;
  for (const fs::path& name : relative.lexically_normal()) {
    at = find_name(*at, name);
    if (!at) return std::nullopt;
  }
  return at->lexically_normal();
}

}  // namespace stride::core
