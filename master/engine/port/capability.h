// Optional capabilities of a unit, beyond the interface that each unit has.
#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITY_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITY_H

#include <concepts>
#include <cstddef>

namespace stride::core {

/// One for each interface in master/engine/port/capabilities.
enum class CapabilityId : unsigned {
  ConfigurationMode,
  StateSaving,
  StateSerialization,
  Resetting,
  IdlePromises,
  DirectionalDerivatives,
  ClockIntervals,
  InputsWithinStep,
  MessageText,
  UnitDiagnostics,
  HostDiagnostics,
  ConcurrentSteps,
  StepsInARow,
  End,  ///< no capability
};

inline constexpr std::size_t kCapabilities = static_cast<std::size_t>(CapabilityId::End);

/// The base of these interfaces. Each has its identifier as a constant kId. An implementation
/// belongs to its unit and exists as long; it is used by the thread that uses the unit, and its
/// functions throw core::Error that names the unit, unless its header states otherwise.
class Capability {
 public:
  Capability() = default;
  Capability(const Capability&) = delete;
  Capability& operator=(const Capability&) = delete;

 protected:
  virtual ~Capability() = default;
};

template <class C>
concept CapabilityInterface = std::derived_from<C, Capability> && requires {
  { C::kId } -> std::convertible_to<CapabilityId>;
};

/// The one of the interfaces Cs of `unit` that has this identifier; null if none has.
template <CapabilityInterface... Cs, class U>
Capability* select_capability(U& unit, CapabilityId id) {
  Capability* selected = nullptr;
  ((Cs::kId == id ? static_cast<void>(selected = static_cast<Cs*>(&unit)) : void()), ...);
  return selected;
}

/// A base of a unit that implements the interfaces Cs, so that each is listed once.
template <CapabilityInterface... Cs>
class Capabilities : public Cs... {
 protected:
  /// The one of them that has this identifier; null if none has.
  Capability* implemented(CapabilityId id) { return select_capability<Cs...>(*this, id); }
};

}  // namespace stride::core

#endif
