#include "master/system/plan/load_units.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "master/base/files/input_file.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {
namespace {

/// Where a unit was looked for: that of a linked scenario also beside what the link leads to.
std::string shown_places(const Scenario& scenario, const std::filesystem::path& source) {
  std::string shown = scenario.files->shown(source);
  std::error_code error;
  if (core::path_exists(source) || !std::filesystem::is_symlink(scenario.path, error)) return shown;
  const std::filesystem::path folder = scenario.path.parent_path();
  const auto inside = source.lexically_relative(folder.empty() ? "." : folder);
  const std::filesystem::path target = std::filesystem::canonical(scenario.path, error);
  if (error || inside.empty()) return shown;
  return shown + "', or '" + (target.parent_path() / inside).lexically_normal().string();
}

}  // namespace

std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario) {
  UnitStore units;
  return load_fmus(scenario, units, hosts_for_loading(scenario, {}));
}

std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario, UnitStore& units,
                                                      std::span<const HostSettings> hosts) {
  UnitStore by_source;
  std::vector<std::shared_ptr<importer::Fmu>> fmus;
  for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
    const core::Location& where = scenario.system.components[i].where;
    const std::filesystem::path& source = scenario.sources[i];
    if (hosts[i].remote && !hosts[i].remote->sends) {
      const remote::RemoteSpec spec = remote_spec(*hosts[i].remote, source);
      auto& fmu = units[key_of(spec)];
      if (!fmu) fmu = remote::describe(spec, hosts[i].remote->where);
      fmus.push_back(fmu);
      continue;
    }
    auto& named = by_source[source];
    if (!named) {
      const auto path = find_unit_shown_as(source, shown_places(scenario, source), where);
      auto& fmu = units[path];
      if (!fmu) fmu = load_unit(path, where, scenario.files->shown(path));
      named = fmu;
    }
    fmus.push_back(named);
  }
  return fmus;
}

}  // namespace stride::scenario
