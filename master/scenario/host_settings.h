// What a scenario or a command line says about the processes that components run in.
#ifndef STRIDE_MASTER_SCENARIO_HOST_SETTINGS_H
#define STRIDE_MASTER_SCENARIO_HOST_SETTINGS_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/scenario/component_selection.h"
#include "master/util/error.h"

namespace stride::io {

/// What is said of one component; nothing where nothing is said.
struct HostSettings {
  std::optional<bool> process{};  ///< whether it has a process of its own
  core::Location where{};         ///< what says so
  std::optional<std::chrono::milliseconds> call_limit{};
  std::optional<std::uint64_t> memory_limit{};  ///< [byte]
  std::optional<bool> sandbox{};
  std::optional<bool> snapshots{};  ///< whether these may roll it back, if it has no state

  /// What the other one says goes before what is said here.
  void override_with(const HostSettings& other);
};

struct HostRule {
  ComponentPattern components;
  HostSettings settings;
};

struct HostRules {
  std::vector<HostRule> rules;  ///< a later one goes before an earlier one

  /// For each of the components. Throws core::Error (Input) for a pattern that matches none.
  std::vector<HostSettings> settings(std::span<const std::string> components) const;
};

/// Takes a number of seconds, and rounds up to milliseconds. Throws std::invalid_argument whose
/// text says what was expected.
std::chrono::milliseconds parse_call_limit(std::string_view text);
/// Takes a whole number of MiB, and returns bytes. Throws likewise.
std::uint64_t parse_memory_limit(std::string_view text);

}  // namespace stride::io

#endif
