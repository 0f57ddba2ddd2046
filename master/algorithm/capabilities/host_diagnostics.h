#ifndef STRIDE_MASTER_ALGORITHM_CAPABILITIES_HOST_DIAGNOSTICS_H
#define STRIDE_MASTER_ALGORITHM_CAPABILITIES_HOST_DIAGNOSTICS_H

#include "master/algorithm/capability.h"
#include "master/algorithm/statistics.h"

namespace stride::core {

/// Of a hosted unit: it runs in a separate process, its host.
class HostDiagnostics : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::HostDiagnostics;

  /// May be called at any time, also after a failure.
  virtual HostStatistics host_statistics() const = 0;
};

}  // namespace stride::core

#endif
