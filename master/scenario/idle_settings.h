// What a scenario or a command line says about idle skipping.
#ifndef STRIDE_MASTER_SCENARIO_IDLE_SETTINGS_H
#define STRIDE_MASTER_SCENARIO_IDLE_SETTINGS_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/run_options.h"
#include "master/model/system.h"
#include "master/scenario/component_selection.h"
#include "master/util/error.h"

namespace stride::io {

/// Whether and for how long components may be left alone.
struct IdleRule {
  ComponentPattern components;
  bool enabled = true;
  std::optional<Duration> max_skip;  ///< none: the default
  core::Location where{};
};

/// A number for "component.variable".
struct IdleNumber {
  std::string variable;
  double value = 0;
  core::Location where{};
};

struct IdleSettings {
  static constexpr Duration kDefaultMaxSkip = std::chrono::seconds(1);

  std::vector<IdleRule> rules;  ///< a later one goes before an earlier one; without one: enabled
  std::vector<IdleNumber> deadbands;
  std::vector<IdleNumber> tolerances;

  /// For a run whose steps are chosen already. Throws core::Error (Input) for a pattern or a
  /// variable that the system has not, a deadband of what is no Float64 input, a tolerance of what
  /// is no output with one, and a max_skip below the step.
  core::IdleOptions options(const core::System& system, const core::StepOptions& step) const;
};

/// Takes the text of a max_skip. Throws std::invalid_argument whose text says what was expected.
Duration parse_max_skip(std::string_view text);

}  // namespace stride::io

#endif
