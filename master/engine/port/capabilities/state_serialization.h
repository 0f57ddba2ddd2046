#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STATE_SERIALIZATION_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STATE_SERIALIZATION_H

#include <cstdint>
#include <span>
#include <vector>

#include "master/engine/port/capability.h"

namespace stride::core {

/// Kept states as bytes. A unit that offers this offers StateSaving, too, whose selected slot it
/// uses.
class StateSerialization : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::StateSerialization;

  /// The state in the slot, for any unit of the same FMU, also in another process. Fails if the
  /// slot is empty.
  virtual std::vector<std::uint8_t> serialize_state() = 0;
  /// Replaces the state in the slot by the serialized one. Also for a unit that was never
  /// initialized; StateSaving::restore_state() then applies it.
  virtual void deserialize_state(std::span<const std::uint8_t> bytes) = 0;
};

}  // namespace stride::core

#endif
