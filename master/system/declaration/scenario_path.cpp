#include "master/system/declaration/scenario_path.h"

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/program_root.h"
#include "master/base/text/suggest.h"

namespace stride::scenario {
namespace {

namespace fs = std::filesystem;

fs::path file_of(const std::string& name, const fs::path& folder) {
  return folder / name / (name + ".ssd");
}

bool can_be_name(const fs::path& path) {
  return path.has_filename() && !path.has_parent_path() && !path.has_extension() &&
         !core::path_exists(path) && core::why_unreachable(path).empty();
}

/// A file beside which its ending was left out, or a scenario that comes with stride.
std::string hint_for(const std::string& name, const fs::path& folder) {
  for (const char* ending : {".ssd", ".ssp", ".fmu", ".csv", ".parquet", ".mcap"}) {
    if (core::path_exists(name + ending)) return fmt::format("did you mean '{}{}'?", name, ending);
  }
  const std::vector<std::string> names = scenario_names(folder);
  return names.empty()
             ? "name a system file (.ssd), a package (.ssp), an FMU (.fmu) or a table (.csv)"
             : core::suggestion(name, names);
}

}  // namespace

fs::path scenario_folder() { return core::program_root() / "share" / "stride" / "scenarios"; }

std::vector<std::string> scenario_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& entry : core::folder_entries(folder)) {
    const std::string name = entry.filename();
    if (core::is_file(file_of(name, folder))) names.push_back(name);
  }
  return names;
}

std::optional<fs::path> named_scenario(const fs::path& name, const fs::path& folder) {
  if (!can_be_name(name)) return std::nullopt;
  const fs::path file = file_of(name, folder);
  return core::is_file(file) ? std::optional(file) : std::nullopt;
}

void refuse_unknown_name(const fs::path& path, const fs::path& folder) {
  if (!can_be_name(path)) return;
  core::fail_input({},
                   fmt::format("there is no file '{}', and no scenario of this name comes with "
                               "stride",
                               path.string()),
                   hint_for(path.string(), folder));
}

}  // namespace stride::scenario
