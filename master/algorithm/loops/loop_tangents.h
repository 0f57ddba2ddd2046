// How an algebraic loop answers to small changes of the inputs at which it is cut.
#ifndef STRIDE_MASTER_ALGORITHM_LOOPS_LOOP_TANGENTS_H
#define STRIDE_MASTER_ALGORITHM_LOOPS_LOOP_TANGENTS_H

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "master/algorithm/capabilities/directional_derivatives.h"
#include "master/algorithm/loops/evaluation_order.h"
#include "master/algorithm/unit.h"
#include "master/model/system.h"

namespace stride::core {

/// The derivatives of one sweep through a loop, by the chain rule, from the directional derivatives
/// of its units.
class LoopTangents {
 public:
  /// `loop` is one, and outlives this object, as do the others.
  LoopTangents(const System& system, std::span<const std::unique_ptr<Unit>> units,
               const EvaluationBlock& loop);

  /// Whether all units in the loop know their derivatives, and only floating-point numbers run
  /// through it.
  static bool exist(const System& system, const EvaluationBlock& loop);

  /// How what comes back to each element of the cut inputs, one tear after the other, changes with
  /// the element `element` of the tear `tear`. The units have their inputs from the last sweep.
  void derive(std::size_t tear, std::size_t element, std::span<double> column);

 private:
  /// Outputs of one component, what of it the loop runs through, and where these lead.
  struct UnitDerivatives {
    std::size_t component;
    DirectionalDerivatives* unit;
    std::vector<ValueReference> unknowns, knowns;
    std::size_t first_output, outputs;  ///< in outputs_
    std::size_t first_input, inputs;    ///< in inputs_
  };
  struct CarriedDerivative {
    std::size_t step;  ///< of the loop, after which it is carried
    std::size_t from, to, size;
    double factor;
  };

  void lay_out_inputs();
  void add_derivatives(const EvaluationStep& step);
  void add_carried();

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  const EvaluationBlock& loop_;
  std::map<VariableId, std::size_t> input_offsets_, output_offsets_;
  std::vector<UnitDerivatives> derivatives_;
  std::vector<CarriedDerivative> carried_;  ///< by step
  std::vector<double> inputs_, outputs_;
};

}  // namespace stride::core

#endif
