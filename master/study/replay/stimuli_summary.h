// What a file of captured stimuli says of itself, and when it has something.
#ifndef STRIDE_MASTER_STUDY_REPLAY_STIMULI_SUMMARY_H
#define STRIDE_MASTER_STUDY_REPLAY_STIMULI_SUMMARY_H

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace stride::replay {

/// Times are exact decimals of seconds, as in the file and in signals.csv.
struct StimuliSummary {
  std::string component;
  /// Those to be played: what the unit was given, and all messages, also where none came. Of an
  /// input that was not connected there is nothing to play.
  std::vector<std::string> inputs;
  std::optional<std::string> max_skip;  ///< [s], or "for ever"; nothing: no idle skipping
  std::string start;
  std::string end;
  std::set<std::string> instants;        ///< at which the unit was given or sent something
  std::set<std::string> event_instants;  ///< those of Event Mode
};

/// Throws core::Error (Input) for what is no such file, and for one without a step or an end mark:
/// nothing can be played.
StimuliSummary summarise_stimuli(const std::filesystem::path& file);

/// All that a replay has to give the unit again to be the same, to be compared: the settings and
/// the rows, but for the reason in the end mark. Throws core::Error (Input) where it cannot be
/// read.
std::string repeated_part(const std::filesystem::path& file);

}  // namespace stride::replay

#endif
