// An algebraic loop between units: x = g(x), x being the inputs at which it is tear.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_ALGEBRAIC_LOOP_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_ALGEBRAIC_LOOP_H

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/context/run_context.h"
#include "master/engine/run/loops/evaluation_order.h"
#include "master/engine/run/loops/loop_derivatives.h"
#include "master/engine/run/loops/loop_solver.h"
#include "master/engine/run/loops/ordered_exchange.h"

namespace stride::core {

/// It is solved in two ways:
///
/// 1. x ← g(x), as long as that settles one input after the other. It does where dependencies were
///    declared, or assumed, that do not exist.
/// 2. solve_loop() from the first x for the floating-point numbers, while all other values are
///    held; then the held values are taken from g(x). Both are repeated until no held value
///    changes.
class AlgebraicLoop {
 public:
  /// Evaluates all outputs in the loop from the inputs at which it is tear.
  using Sweep = std::function<void()>;

  /// `plan` is a loop and outlives this object, as do the others.
  AlgebraicLoop(RunContext& context, const EvaluationBlock& plan, OrderedExchange& exchange);

  /// Reads the start values of the tearing variables from the units.
  void guess();
  /// Whether the last sweep gave back the tearing variables: numbers to within rounding, others
  /// exactly.
  bool has_converged();
  /// After a sweep that has not converged: changes the inputs until one has. Throws Error (Run)
  /// with the path and the last values if no solution is found.
  void solve(const Sweep& sweep, Time time);

 private:
  /// A tearing variable: inputs that get the same value, and the output that it comes from.
  struct Tear {
    const TearingVariable* variable;
    ValueSlice source;
    std::vector<OrderedExchange::Link> links;
    ValueBlock result;  ///< the value of the source, converted for the inputs
    bool is_real;
  };
  /// One element of a tear.
  struct Unknown {
    std::size_t tear;
    std::size_t element;
  };
  using Values = std::vector<ValueBlock>;  // by tear

  void sweep();
  void collect();
  bool has_converged(const Unknown& unknown) const;
  bool have_held_values_converged() const;
  bool iterate();
  bool solve_reals();
  Values inputs() const;
  void put(const Values& values);
  void put(Tear& tear, const ValueBlock& value);
  void put(std::span<const double> x);
  [[noreturn]] void fail(Time time) const;
  std::string values_text() const;
  std::string hint() const;

  const System& system_;
  const EvaluationBlock& plan_;
  OrderedExchange& exchange_;
  std::vector<Tear> tears_;
  std::vector<Unknown> unknowns_;
  std::vector<Unknown> reals_;  ///< those of the unknowns that Newton's method is for
  LoopScale scale_;             ///< of the reals
  std::optional<LoopDerivatives> derivatives_;  ///< where the units provide their derivatives

  const Sweep* sweep_ = nullptr;
  std::size_t sweeps_ = 0;
};

}  // namespace stride::core

#endif
