// The folder of a regression suite: replays of a device, each compared with what it did.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_REPLAY_SUITE_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_REPLAY_SUITE_H

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/replay/replay_files.h"

namespace stride::cli {

/// "case_000017"
std::string replay_name(const campaign::Plan& plan, std::uint64_t index);

/// It grows beside its place, and is put there as a whole.
class ReplaySuite {
 public:
  struct Options {
    std::string component;  ///< the device
    std::string tolerance;  ///< of real numbers at the end; empty: all bits
  };

  /// All must outlive it. Throws core::Error (Input) where the folder has something already, or
  /// cannot be written.
  ReplaySuite(const CampaignInput& input, const campaign::CaseFolder& cases,
              std::filesystem::path folder, const Options& options);
  /// Removes what is not published.
  ~ReplaySuite();
  ReplaySuite(const ReplaySuite&) = delete;
  ReplaySuite& operator=(const ReplaySuite&) = delete;

  /// Writes the replay of a case, runs it, and compares it: with the stimuli that it is made of,
  /// with what the case has covered, with its results, if these are kept, and with itself. Nothing
  /// if all is the same and it is in the suite, otherwise why it cannot be. Throws core::Error as
  /// run_replay() does, and where something cannot be written.
  std::optional<std::string> add(std::uint64_t index, const campaign::CaseResult& result);
  bool has(std::uint64_t index) const { return added_.contains(index); }
  /// Whether it was compared with the results of the case, too.
  bool is_compared(std::uint64_t index) const { return added_.at(index); }

  /// Leaves the others out, adds the script and this page, and puts the folder in its place.
  void publish(const std::set<std::uint64_t>& kept, const std::string& page);

 private:
  std::optional<std::string> why_unlike(std::uint64_t index, const replay::ReplaySource& source,
                                        const campaign::CaseResult& result);
  std::optional<std::string> why_covered_other(const std::filesystem::path& results,
                                               const campaign::CaseResult& result) const;
  std::optional<std::string> why_received_other(const replay::ReplaySource& source) const;
  std::filesystem::path golden(const std::string& name) const;
  void drop(const std::string& name);

  const CampaignInput& input_;
  const campaign::CaseFolder& cases_;
  const std::filesystem::path folder_;
  const std::filesystem::path fresh_;
  std::optional<recorders::ResultsLock> lock_;  ///< of it
  const Options options_;
  replay::ReplayFiles files_;
  std::map<std::uint64_t, bool> added_;
};

}  // namespace stride::cli

#endif
