#include "master/system/scenario/units/unit_path.h"

#include <cstdlib>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/files/program_root.h"
#include "master/base/files/table_file.h"
#include "master/base/text/lower_case.h"
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

/// Folders in this one, without hidden ones.
std::vector<fs::path> folders_in(const fs::path& folder) {
  constexpr std::size_t kMost = 100;
  std::vector<fs::path> folders;
  for (const fs::path& entry : core::folder_entries(folder)) {
    const bool is_hidden = entry.filename().string().starts_with('.');
    if (!is_hidden && folders.size() < kMost && core::is_folder(entry)) folders.push_back(entry);
  }
  return folders;
}

/// A file of this name near where it was looked for: beside the file that names it, in the folders
/// there, or one level above. Relative to that file, as a source is.
std::string near_unit(const fs::path& path, const core::Location& where) {
  fs::path base;
  if (core::is_file(where.file)) base = fs::path(where.file).parent_path();
  if (base.empty()) base = ".";
  std::vector<fs::path> places = folders_in(base);
  places.insert(places.begin(), base);
  places.push_back(base / "..");
  for (const fs::path& place : places) {
    const fs::path file = (place / path.filename()).lexically_normal();
    if (core::path_exists(file)) return file.lexically_proximate(base);
  }
  return "";
}

/// A class of Python beside the unit that could be made of it, "pump.py" for "Pump.fmu".
std::string python_hint(const fs::path& path) {
  const std::string wanted = core::lower_case(path.stem().string());
  for (const fs::path& entry :
       core::folder_entries(path.has_parent_path() ? path.parent_path() : ".")) {
    const bool is_it =
        entry.extension() == ".py" && core::lower_case(entry.stem().string()) == wanted;
    if (!is_it) continue;
    return fmt::format("a unit in Python is packed first: python3 -m stride.unit {} -o {}",
                       entry.filename().string(), path.filename().string());
  }
  return "";
}

std::string unit_hint(const fs::path& path, const core::Location& where,
                      std::span<const std::string> known) {
  if (const std::string near = near_unit(path, where); !near.empty()) {
    return fmt::format("did you mean '{}'?", near);
  }
  if (const std::string hint = python_hint(path); !hint.empty()) return hint;
  if (known.empty()) return "build the unit, or name its folder in STRIDE_UNITS";
  return core::suggestion(path.filename().string(), known);
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
                   unit_hint(path, where, known));
}

}  // namespace stride::scenario
