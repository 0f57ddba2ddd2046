// What a scenario or a command line sets of steps, processes and idle skipping.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_RUN_SETTINGS_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_RUN_SETTINGS_H

#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"
#include "master/loader/network/place.h"
#include "master/system/declaration/component_selection.h"

namespace stride::scenario {

/// The step of the components that match.
struct ComponentStep {
  ComponentPattern components;
  core::Interval size{};
};

/// By component; nothing: it has none of its own.
using ComponentSteps = std::vector<std::optional<core::Interval>>;

/// What is set of the stepping; nothing where it is not set.
struct StepSettings {
  std::optional<const core::StepPolicyType*> policy;
  std::optional<core::Interval> size;
  std::optional<core::Interval> maximum;
  std::optional<core::Interval> minimum;
  std::optional<double> relative_tolerance;
  std::optional<double> absolute_tolerance;
  std::optional<core::Coupling> coupling;
  std::optional<core::Extrapolation> extrapolation;
  std::vector<ComponentStep> of_components;

  /// Each takes a text into its place. Throws std::invalid_argument whose text contains what was
  /// expected. Times are above 0 s, tolerances at least 0.
  void set_policy(std::string_view text);
  void set_size(std::string_view text);
  void set_maximum(std::string_view text);
  void set_minimum(std::string_view text);
  void set_relative_tolerance(std::string_view text);
  void set_absolute_tolerance(std::string_view text);
  void set_coupling(std::string_view text);
  void set_extrapolation(std::string_view text);
  /// "SECONDS", once, or "COMPONENT=SECONDS", of the option --step.
  void set_step(std::string_view text);

  /// What is set here replaces the value in the options.
  void apply(core::RunOptions& options) const;
  /// Of each component the step that is set for it alone. Throws core::Error (Input) for a pattern
  /// that matches none, and where two of them match one component.
  ComponentSteps component_steps(std::span<const std::string> names) const;
};

/// Of a component whose unit runs on another machine.
struct RemoteSettings {
  remote::Place place{};
  std::optional<std::string> fmu{};  ///< its path or name there; none: the name of the source
  bool sends = false;                ///< the source is sent there
  std::optional<std::chrono::milliseconds> connect_limit{}, silence_limit{};
  core::Location where{};
  const volatile std::sig_atomic_t* interrupted = nullptr;  ///< ends a wait for the machine
};

/// The settings of the host of one component; each may be missing.
struct HostSettings {
  std::optional<bool> process{};  ///< whether the component has a host
  core::Location where{};         ///< of that setting
  std::optional<std::chrono::milliseconds> call_limit{};
  std::optional<std::uint64_t> memory_limit{};  ///< [byte]
  std::optional<bool> sandbox{};
  std::optional<bool> snapshots{};         ///< whether these may roll it back, if it has no state
  std::optional<RemoteSettings> remote{};  ///< none: it runs on this machine

  /// The settings of the other one take precedence.
  void override_with(const HostSettings& other);
};

struct HostRule {
  ComponentPattern components;
  HostSettings settings;
};

struct HostRules {
  std::vector<HostRule> rules;  ///< a later one takes precedence

  /// For each of the components. Throws core::Error (Input) for a pattern that matches none.
  std::vector<HostSettings> settings(std::span<const std::string> components) const;
};

/// Takes a number of seconds, and rounds up to milliseconds. Throws std::invalid_argument whose
/// text contains what was expected.
std::chrono::milliseconds parse_call_limit(std::string_view text);
/// Takes a whole number of MiB, and returns bytes. Throws likewise.
std::uint64_t parse_memory_limit(std::string_view text);

/// Whether and for how long components may be suspended.
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

  std::vector<IdleRule> rules;  ///< a later one takes precedence; without one: enabled
  std::vector<IdleNumber> deadbands;
  std::vector<IdleNumber> tolerances;

  /// For a run whose steps are chosen already. Throws core::Error (Input) for a pattern or a
  /// variable that the system has not, a deadband of what is not a Float64 input, a tolerance of
  /// what is not an output with one, and a max_skip below the step.
  core::IdleOptions options(const core::System& system, const core::StepOptions& step) const;
};

/// Takes the text of a max_skip. Throws std::invalid_argument whose text contains what was
/// expected.
Duration parse_max_skip(std::string_view text);

}  // namespace stride::scenario

#endif
