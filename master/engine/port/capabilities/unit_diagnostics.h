#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_UNIT_DIAGNOSTICS_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_UNIT_DIAGNOSTICS_H

#include <cstdint>
#include <string>

#include "master/engine/port/capability.h"

namespace stride::core {

/// What is said about the unit, and by it. At any time, also after a failure. Throws nothing.
class UnitDiagnostics : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::UnitDiagnostics;

  /// The unit's log message for the last step that it rejected; empty if there was none.
  virtual std::string rejection_reason() const = 0;
  /// How many functions of the unit's own interface were called so far.
  virtual std::uint64_t calls() const = 0;
  /// Until it is called with false, calls repeat earlier ones: messages are not logged again.
  virtual void set_repeating(bool /*repeating*/) {}
};

}  // namespace stride::core

#endif
