#ifndef STRIDE_MASTER_ALGORITHM_CAPABILITIES_OWN_PROCESS_H
#define STRIDE_MASTER_ALGORITHM_CAPABILITIES_OWN_PROCESS_H

#include "master/algorithm/capability.h"
#include "master/algorithm/statistics.h"

namespace stride::core {

/// The unit has a process to itself.
class HostDiagnostics : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::HostDiagnostics;

  /// Of that process. At any time, also after a failure.
  virtual HostStatistics host_statistics() const = 0;
};

}  // namespace stride::core

#endif
