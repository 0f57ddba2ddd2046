// Hosted units: each runs in a separate process, its host.
#ifndef STRIDE_MASTER_ISOLATION_HOSTED_UNIT_H
#define STRIDE_MASTER_ISOLATION_HOSTED_UNIT_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/algorithm/unit.h"
#include "master/importer/fmu.h"

namespace stride::isolation {

/// The category of log messages that are lines of a unit's standard output or error.
inline constexpr const char* kPrinted = "printed";

struct HostOptions {
  std::optional<std::chrono::milliseconds> call_limit{};  ///< of each call; nothing = no limit
  std::optional<std::uint64_t> memory_limit{};            ///< of the unit's data [byte]
  bool is_sandboxed = true;
  /// Folders that the unit may write to, beside its own resources.
  std::vector<std::filesystem::path> writable{};
  /// Whether save_state() forks, if the unit cannot save its state itself.
  bool takes_snapshots = false;
};

/// Makes an instance in a host, a process of its own: its library is loaded there and nowhere else,
/// but for a bare one, which is asked for its description here (importer::Fmu). To be called while
/// this process has one thread.
///
/// The instance behaves as one of fmu->instantiate(), with the same errors. Beyond those, a call of
/// a unit whose process ends, or which takes longer than its limit, throws core::Error of the kind
/// Run with the call, the simulated time, how the process ended and the unit's last lines, and so
/// does each call after it but terminate(), which does nothing then. `options.warn_after` is also
/// how long a call may take before it is logged. Nothing of the process stays when the unit is
/// destroyed, or when this process ends, however it does.
std::unique_ptr<core::Unit> instantiate(std::shared_ptr<importer::Fmu> fmu, const std::string& name,
                                        importer::InstanceOptions options, HostOptions host);

}  // namespace stride::isolation

#endif
