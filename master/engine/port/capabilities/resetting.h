#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_RESETTING_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_RESETTING_H

#include "master/engine/port/capability.h"

namespace stride::core {

class Resetting : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::Resetting;

  /// Restores the state after instantiation, without start values. Saved states are kept. Also
  /// after the unit has failed or was terminated.
  virtual void reset() = 0;
};

}  // namespace stride::core

#endif
