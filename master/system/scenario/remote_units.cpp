#include "master/system/scenario/remote_units.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/loader/network/description_files.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {

remote::RemoteSpec remote_spec(const RemoteSettings& settings,
                               const std::filesystem::path& source) {
  remote::RemoteSpec spec;
  spec.place = settings.place;
  spec.fmu = settings.fmu.value_or(source.filename().string());
  spec.connect_limit = settings.connect_limit.value_or(spec.connect_limit);
  spec.interrupted = settings.interrupted;
  spec.silence_limit = settings.silence_limit.value_or(spec.silence_limit);
  if (!settings.sends) return spec;
  spec.sent = find_unit(source, settings.where);
  if (core::is_file(spec.sent) && spec.sent.extension() == ".fmu") return spec;
  core::fail_input({.where = settings.where},
                   fmt::format("'{}' is no FMU in one file, so it cannot be sent", source.string()),
                   "pack it (stride pack), or name an FMU of that machine (fmu=\"…\")");
}

std::vector<HostSettings> hosts_for_loading(const Scenario& scenario, const HostRequest& request) {
  const HostRules& rules = scenario.annotation.hosts;
  const bool has_any =
      !request.places.empty() || std::ranges::any_of(rules.rules, [](const HostRule& rule) {
        return rule.settings.remote.has_value();
      });
  std::vector<std::string> names;
  for (const auto& component : scenario.system.components) names.push_back(component.name);
  return has_any ? host_settings(names, rules, request) : std::vector<HostSettings>(names.size());
}

std::string description_digest(const importer::Fmu& fmu) {
  return remote::description_digest(fmu.description_files());
}

std::filesystem::path key_of(const remote::RemoteSpec& spec) {
  std::string key = spec.place.text;
  for (const std::string& word : spec.place.command) key += '\n' + word;
  return key + '\n' + spec.fmu;
}

}  // namespace stride::scenario
