#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVE_OPTIONS_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVE_OPTIONS_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/loader/network/server/unit_offer.h"

namespace stride::remote {

/// What a server offers and allows.
struct ServeOptions {
  std::vector<std::string> only{};  ///< the FMUs that are offered; empty: all that are found
  UnitOffer::Find find{};
  /// Of an FMU that is sent, and of its files together [byte]; none is accepted without.
  std::optional<std::uint64_t> file_limit{};
  /// Limits for all units; the master may set lower ones.
  std::optional<std::chrono::milliseconds> call_limit{};
  std::optional<std::uint64_t> memory_limit{};  ///< [byte]
  bool may_leave_sandbox = false;               ///< where the master wants so
};

}  // namespace stride::remote

#endif
