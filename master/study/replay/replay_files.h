// The files of replays, all in one folder, which can be put anywhere.
#ifndef STRIDE_MASTER_STUDY_REPLAY_REPLAY_FILES_H
#define STRIDE_MASTER_STUDY_REPLAY_REPLAY_FILES_H

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "master/study/replay/replay_system.h"
#include "master/system/scenario/units/fmu_archives.h"

namespace stride::replay {

/// Where a replay comes from.
struct ReplaySource {
  const scenario::RunPlan& loaded;
  std::size_t component;
  std::filesystem::path stimuli;
};

/// Writes replays into a folder that exists: NAME.ssd, stimuli_NAME.fmu, which plays the stimuli,
/// and once for all of them the FMU of each device.
class ReplayFiles {
 public:
  explicit ReplayFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws core::Error, also as summarise_stimuli() does. Until expect() it expects nothing.
  void write(const std::string& name, const ReplaySource& source);
  /// Writes the .ssd again, with what the replay of this name is expected to do.
  void expect(const std::string& name, const ReplaySource& source,
              std::vector<Expectation> expectations) const;
  /// Those of one replay.
  void remove(const std::string& name) const;
  /// The FMUs of devices that none of these replays needs are removed.
  void keep_units_of(const std::set<std::string>& names);

  std::filesystem::path system_file(const std::string& name) const;

 private:
  std::string add_unit(const ReplaySource& source);
  std::filesystem::path player_file(const std::string& name) const;

  std::filesystem::path folder_;
  scenario::FmuArchives archives_;
  std::map<std::filesystem::path, std::string> units_;  ///< names here, by where they are from
  std::map<std::string, std::string> unit_of_;          ///< by the replay
};

}  // namespace stride::replay

#endif
