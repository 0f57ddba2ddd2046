// What a scenario or a command line says about the stepping, as far as it says anything.
#ifndef STRIDE_MASTER_SCENARIO_STEP_CHOICE_H
#define STRIDE_MASTER_SCENARIO_STEP_CHOICE_H

#include <optional>
#include <string_view>

#include "master/algorithm/run_options.h"

namespace stride::io {

struct StepChoice {
  std::optional<const core::StepPolicyType*> policy;
  std::optional<Duration> size;
  std::optional<Duration> maximum;
  std::optional<Duration> minimum;
  std::optional<double> relative_tolerance;
  std::optional<double> absolute_tolerance;
  std::optional<core::Coupling> coupling;
  std::optional<core::Extrapolation> extrapolation;

  /// Each takes a text into its place. Throws std::invalid_argument whose text says what was
  /// expected. Times are above 0 s, tolerances at least 0.
  void set_policy(std::string_view text);
  void set_size(std::string_view text);
  void set_maximum(std::string_view text);
  void set_minimum(std::string_view text);
  void set_relative_tolerance(std::string_view text);
  void set_absolute_tolerance(std::string_view text);
  void set_coupling(std::string_view text);
  void set_extrapolation(std::string_view text);

  /// What is said here replaces what stands in the options.
  void apply(core::RunOptions& options) const;
};

}  // namespace stride::io

#endif
