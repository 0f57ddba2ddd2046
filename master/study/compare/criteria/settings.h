#ifndef STRIDE_MASTER_STUDY_COMPARE_CRITERIA_SETTINGS_H
#define STRIDE_MASTER_STUDY_COMPARE_CRITERIA_SETTINGS_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/study/compare/criteria/tolerances.h"

namespace stride::compare {

/// What counts as equal. Without any of it, that is the same bits at the same instants.
struct Settings {
  Tolerance tolerance{};                      ///< of reals
  std::vector<SignalTolerance> tolerances{};  ///< of some signals
  /// Of instants; if there is one, signals are compared as curves, at the instants of both.
  std::optional<Duration> time_tolerance{};
  std::vector<std::string> only{};     ///< patterns of signals and messages
  std::vector<std::string> ignored{};  ///< likewise
  /// B is kept as a reference: what it has is compared, at its instants, within its tolerances.csv.
  bool is_golden = false;
};

}  // namespace stride::compare

#endif
