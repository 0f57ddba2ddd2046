#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_INPUTS_WITHIN_STEP_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_INPUTS_WITHIN_STEP_H

#include <functional>

#include "master/engine/port/capability.h"

namespace stride::core {

/// Called by a unit within a step, `seconds_into_step` [s] after its begin, on the thread of the
/// step: sets those of the unit's inputs that have Variable::intermediate_update to their values at
/// that instant. The instants come in any order.
using InputUpdate = std::function<void(double seconds_into_step)>;

/// Units without this capability use the inputs set before the step.
class InputsWithinStep : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::InputsWithinStep;

  /// Sets the function that the unit calls from now on; an empty one removes it. Its exceptions
  /// leave Unit::step().
  virtual void set_input_update(InputUpdate update) = 0;
};

}  // namespace stride::core

#endif
