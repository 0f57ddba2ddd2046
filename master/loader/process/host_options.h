#ifndef STRIDE_MASTER_LOADER_PROCESS_HOST_OPTIONS_H
#define STRIDE_MASTER_LOADER_PROCESS_HOST_OPTIONS_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace stride::isolation {

/// The category of log messages that are lines of a unit's standard output or error.
inline constexpr const char* kPrinted = "printed";

/// What a hosted unit may do, and how long and with how much memory.
struct HostOptions {
  std::optional<std::chrono::milliseconds> call_limit{};  ///< of each call; nothing = no limit
  std::optional<std::uint64_t> memory_limit{};            ///< of the unit's data [byte]
  bool is_sandboxed = true;
  /// Folders that the unit may write to, beside its own resources.
  std::vector<std::filesystem::path> writable{};
  /// Whether save_state() forks, if the unit cannot save its state itself.
  bool takes_snapshots = false;
};

}  // namespace stride::isolation

#endif
