// The digests of what a scenario consists of.
#ifndef STRIDE_MASTER_CAMPAIGN_FILE_DIGESTS_H
#define STRIDE_MASTER_CAMPAIGN_FILE_DIGESTS_H

#include <filesystem>
#include <map>
#include <string>

#include "master/scenario/loaded_scenario.h"

namespace stride::campaign {

/// Keeps those of the files that it has read.
class FileDigests {
 public:
  /// Of the system files and parameter sets, by their paths from the folder of the scenario.
  std::map<std::string, std::string> files(const scenario::Scenario& scenario);
  /// Of the unit of a component: an archive, a folder with all that is in it, or a library with its
  /// resources.
  std::string unit(const scenario::LoadedScenario& loaded, std::size_t component);

 private:
  const std::string& file(const std::filesystem::path& path);
  const std::string& folder(const std::filesystem::path& path);

  std::map<std::filesystem::path, std::string> known_;
};

}  // namespace stride::campaign

#endif
