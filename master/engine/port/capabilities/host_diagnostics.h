#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_HOST_DIAGNOSTICS_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_HOST_DIAGNOSTICS_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/capability.h"

namespace stride::core {

/// The link to another machine.
struct LinkStatistics {
  std::string machine;  ///< "user@machine"
  std::uint64_t round_trips = 0;
  std::uint64_t sent = 0, received = 0;  ///< [byte]
  /// Waited for answers, without the time that their making took there.
  std::chrono::nanoseconds lost{};
};

/// Statistics of a unit's host, the separate process that it runs in.
struct HostStatistics {
  std::uint64_t snapshots = 0;             ///< snapshots made
  std::uint64_t restores = 0;              ///< restores from a snapshot
  std::size_t most_snapshots = 0;          ///< maximum kept at once
  std::uint64_t most_snapshot_memory = 0;  ///< their maximum private memory [byte]
  std::uint64_t most_memory = 0;  ///< maximum resident memory of the serving process [byte]
  std::vector<std::string> protections{};          ///< in force
  std::vector<std::string> missing_protections{};  ///< requested, but not available
  std::optional<LinkStatistics> link{};            ///< if it runs on another machine
};

/// Of a hosted unit: it runs in a separate process, its host.
class HostDiagnostics : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::HostDiagnostics;

  /// May be called at any time, also after a failure.
  virtual HostStatistics host_statistics() const = 0;
};

}  // namespace stride::core

#endif
