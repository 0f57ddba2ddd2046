#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CONFIGURATION_MODE_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CONFIGURATION_MODE_H

#include "master/engine/port/capability.h"

namespace stride::core {

/// Structural parameters, which give arrays their sizes. Call order, before any other function:
/// enter_configuration_mode(), Unit::set() of structural parameters, exit_configuration_mode().
class ConfigurationMode : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::ConfigurationMode;

  virtual void enter_configuration_mode() = 0;
  virtual void exit_configuration_mode() = 0;
};

}  // namespace stride::core

#endif
