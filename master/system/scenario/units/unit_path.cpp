#include "master/system/scenario/units/unit_path.h"

#include <cstdlib>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/files/program_root.h"
#include "master/base/files/table_file.h"
#include "master/base/text/suggest.h"

namespace stride::scenario {
namespace {

namespace fs = std::filesystem;

/// The FMUs in the folders, and the tables in the first one, for suggestions.
std::vector<std::string> known_units(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    for (const fs::path& unit : core::folder_entries(folder)) {
      const bool is_unit = unit.extension() == ".fmu" || unit.extension() == ".so" ||
                           (core::is_table_name(unit) && &folder == folders.data()) ||
                           core::path_exists(unit / "modelDescription.xml");
      if (is_unit) names.push_back(unit.filename().string());
    }
  }
  return names;
}

}  // namespace

std::vector<fs::path> unit_folders() {
  std::vector<fs::path> folders;
  if (const char* const listed = std::getenv("STRIDE_UNITS")) {
    std::string rest = listed;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(':'), rest.size());
      if (end > 0) folders.emplace_back(rest.substr(0, end));
      rest.erase(0, end + 1);
    }
  }
  if (const fs::path root = core::program_root(); !root.empty()) {
    folders.push_back(root / "units");
    folders.push_back(root / "lib" / "stride" / "units");
  }
  return folders;
}

fs::path find_unit(const fs::path& path, const core::Location& where) {
  return find_unit_shown_as(path, path.string(), where);
}

fs::path find_unit_shown_as(const fs::path& path, const std::string& shown_as,
                            const core::Location& where) {
  if (core::path_exists(path)) return path;
  if (core::is_link_loop(path)) {
    core::fail_input({where, {}, {}, {}},
                     fmt::format("'{}': {}", shown_as, core::why_unreachable(path)),
                     core::kLinkLoopHint);
  }
  if (path.filename().empty()) {
    core::fail_input({where, {}, {}, {}}, fmt::format("there is no unit '{}'", shown_as));
  }
  const std::vector<fs::path> folders = unit_folders();
  std::string searched;
  for (const fs::path& folder : folders) {
    const fs::path candidate = folder / path.filename();
    if (core::path_exists(candidate)) return candidate;
    searched += fmt::format("\n    {}", folder.string());
  }
  std::vector<fs::path> places{path.has_parent_path() ? path.parent_path() : fs::path(".")};
  places.insert(places.end(), folders.begin(), folders.end());
  const std::vector<std::string> known = known_units(places);
  core::fail_input({where, {}, {}, {}},
                   fmt::format("there is no unit '{}', and none named '{}' in{}", shown_as,
                               path.filename().string(), searched),
                   known.empty() ? "build the unit, or name its folder in STRIDE_UNITS"
                                 : core::suggestion(path.filename().string(), known));
}

}  // namespace stride::scenario
