#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STATE_SAVING_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STATE_SAVING_H

#include <cstddef>

#include "master/engine/port/capability.h"
#include "master/engine/port/unit.h"

namespace stride::core {

/// States of the unit that are kept in it, each in a slot. Inputs are a part of the state.
class StateSaving : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::StateSaving;

  /// Keeps the present state in the selected slot, instead of what it held. In any mode. A unit
  /// that cannot, though it declares that it can, may leave the slot empty: it runs where nothing
  /// is restored.
  virtual void save_state() = 0;
  /// Makes the unit what it was at save_state(), any number of times. Fails if the slot is empty.
  virtual void restore_state() = 0;
  /// Sets the inputs, saves the state with them, steps and gets the outputs, as Unit::step() does:
  /// for units to which these cost less together. `unit` is the one that is to be called, which is
  /// this one or decorates it.
  virtual StepResult save_with_step(Unit& unit, const StepInterval& interval,
                                    const StepValues& values) {
    for (const BoundValues& input : values.inputs) unit.set(input.references, *input.block);
    save_state();
    return unit.step(interval, {{}, values.outputs});
  }
  /// Selects the slot that the functions above, and StateSerialization, use: slot 0 until another
  /// is selected. The other slots keep their states. A unit with one slot throws std::logic_error.
  virtual void select_state(std::size_t slot) = 0;
};

}  // namespace stride::core

#endif
