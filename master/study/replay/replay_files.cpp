#include "master/study/replay/replay_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/loader/fmu/pack.h"
#include "master/system/scenario/units/file_units.h"

namespace stride::replay {

namespace fs = std::filesystem;

fs::path ReplayFiles::system_file(const std::string& name) const {
  return folder_ / (name + ".ssd");
}

fs::path ReplayFiles::player_file(const std::string& name) const {
  return folder_ / fmt::format("stimuli_{}.fmu", name);
}

/// The name that the unit's FMU has here.
std::string ReplayFiles::add_unit(const ReplaySource& source) {
  const fs::path& path = source.loaded.scenario().sources[source.component];
  const auto [place, is_new] = units_.try_emplace(path);
  if (!is_new) return place->second;
  const std::string stem = path.stem().string();
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(units_, [&](const auto& unit) { return unit.second == name; });
  };
  std::string name = stem + ".fmu";
  for (int i = 2; is_taken(name); ++i) name = fmt::format("{}_{}.fmu", stem, i);
  core::copy_input(archives_(path, {}), folder_ / name);
  return place->second = name;
}

void ReplayFiles::write(const std::string& name, const ReplaySource& source) {
  unit_of_[name] = add_unit(source);
  expect(name, source, {});
  scenario::pack_stimuli(
      {.library = source.stimuli, .resources = {}, .bundled = {}, .output = player_file(name)});
}

void ReplayFiles::expect(const std::string& name, const ReplaySource& source,
                         std::vector<Expectation> expectations) const {
  const StimuliSummary stimuli = summarise_stimuli(source.stimuli);
  core::Replacement file(system_file(name));
  file.file().write(replay_system({.name = name,
                                   .loaded = source.loaded,
                                   .component = source.component,
                                   .stimuli = stimuli,
                                   .unit = unit_of_.at(name),
                                   .player = player_file(name).filename().string(),
                                   .expectations = std::move(expectations)}));
  file.commit();
}

void ReplayFiles::remove(const std::string& name) const {
  std::error_code ignored;
  fs::remove(system_file(name), ignored);
  fs::remove(player_file(name), ignored);
}

void ReplayFiles::keep_units_of(const std::set<std::string>& names) {
  std::set<std::string> needed;
  for (const auto& [name, unit] : unit_of_) {
    if (names.contains(name)) needed.insert(unit);
  }
  std::error_code ignored;
  for (const auto& [path, unit] : units_) {
    if (!needed.contains(unit)) fs::remove(folder_ / unit, ignored);
  }
}

}  // namespace stride::replay
