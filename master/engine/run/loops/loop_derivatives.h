// The derivatives of an algebraic loop in its tearing variables.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_LOOP_DERIVATIVES_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_LOOP_DERIVATIVES_H

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/unit.h"
#include "master/engine/run/loops/evaluation_order.h"

namespace stride::core {

/// The derivatives of one sweep through a loop, by the chain rule, from the directional derivatives
/// of its units.
class LoopDerivatives {
 public:
  /// `loop` is one, and outlives this object, as do the others.
  LoopDerivatives(const System& system, std::span<const std::unique_ptr<Unit>> units,
                  const EvaluationBlock& loop);

  /// Whether all units in the loop provide their derivatives, and all its values are floating-point
  /// numbers.
  static bool exist(const System& system, const EvaluationBlock& loop);

  /// Writes the derivative of the values that one sweep gives back, for each element of the
  /// tearing variables, one after the other, in the element `element` of the tearing variable
  /// `variable`. The units have their inputs from the last sweep.
  void derive(std::size_t variable, std::size_t element, std::span<double> column);

 private:
  /// The derivatives of the outputs of one component in those of its inputs that are in the loop.
  struct UnitDerivatives {
    std::size_t component;
    DirectionalDerivatives* unit;
    std::vector<ValueReference> unknowns, knowns;
    std::size_t first_output, outputs;  ///< in outputs_
    std::size_t first_input, inputs;    ///< in inputs_
  };
  /// A connection that carries the derivatives of outputs on to inputs.
  struct CarriedDerivative {
    std::size_t group;  ///< of the loop, after which it is carried
    std::size_t from, to, size;
    double factor;
  };

  void lay_out_inputs();
  void add_derivatives(const OutputGroup& group);
  void add_carried();

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  const EvaluationBlock& loop_;
  std::map<VariableId, std::size_t> input_offsets_, output_offsets_;
  std::vector<UnitDerivatives> derivatives_;
  std::vector<CarriedDerivative> carried_;  ///< by group
  std::vector<double> inputs_, outputs_;
};

}  // namespace stride::core

#endif
