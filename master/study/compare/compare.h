// Two results folders, side by side.
#ifndef STRIDE_MASTER_STUDY_COMPARE_COMPARE_H
#define STRIDE_MASTER_STUDY_COMPARE_COMPARE_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "master/study/compare/criteria/difference.h"
#include "master/study/compare/criteria/settings.h"
#include "master/study/compare/inputs.h"

namespace stride::compare {

struct Comparison {
  std::filesystem::path a;
  std::filesystem::path b;
  /// The first one first; those of a run as a whole, which have no time, are behind the others.
  Differences differences{};
  /// Nothing where a run says nothing about them.
  std::optional<std::vector<InputDifference>> inputs{};
  std::size_t signals = 0;           ///< of A, that were compared,
  std::size_t rows = 0;              ///< and the rows of them; of a golden folder those of B
  std::size_t messages = 0;          ///< of A
  std::vector<std::string> notes{};  ///< what is cut off
};

/// What is never compared, in words.
extern const char* const kNotCompared;

/// Reads both folders into memory; it takes as much as the larger of the files signals.csv and
/// events.csv of both, and time that grows with their sizes. Throws core::Error (Input) for a
/// folder without results, a file that is malformed, and a pattern that means nothing.
Comparison compare_results(const std::filesystem::path& a, const std::filesystem::path& b,
                           const Settings& settings);

}  // namespace stride::compare

#endif
