// What decides the results of a campaign beside its settings: its files, as their digests.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_FINGERPRINTS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_FINGERPRINTS_H

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stride::campaign {

struct Fingerprints {
  std::string version;  ///< of stride
  /// By their paths from the folder of the scenario, or in its package.
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> units;  ///< of the scenario's components, by their names
  /// Of the alternatives of swaps, by the names of swap and alternative.
  std::map<std::pair<std::string, std::string>, std::string> alternatives;
};

}  // namespace stride::campaign

#endif
