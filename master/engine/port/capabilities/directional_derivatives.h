#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_DIRECTIONAL_DERIVATIVES_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_DIRECTIONAL_DERIVATIVES_H

#include <span>

#include "master/engine/model/description.h"
#include "master/engine/port/capability.h"

namespace stride::core {

class DirectionalDerivatives : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::DirectionalDerivatives;

  /// How Float64 and Float32 unknowns change with known inputs: the sum over the knowns of
  /// (∂ unknown / ∂ known) seed. `seed` has one element for each element of the knowns,
  /// `sensitivity` one for each of the unknowns, arrays element by element, in the variables' units
  /// of measure. In Initialization Mode, Event Mode and Step Mode; changes nothing.
  virtual void get_directional_derivative(std::span<const ValueReference> unknowns,
                                          std::span<const ValueReference> knowns,
                                          std::span<const double> seed,
                                          std::span<double> sensitivity) = 0;
};

}  // namespace stride::core

#endif
