// Solves x = g(x) for numbers.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_LOOP_SOLVER_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_LOOP_SOLVER_H

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace stride::core {

/// Writes g(x), of the same size as x.
using LoopFunction = std::function<void(std::span<const double> x, std::span<double> g)>;

/// Writes ∂g/∂x at x, column by column; x is where g was evaluated last.
using LoopJacobian = std::function<void(std::span<const double> x, std::span<double> columns)>;

struct LoopScale {
  /// Of each unknown the magnitude that it is expected to have; 0 = not known.
  std::vector<double> nominals;
  /// The relative precision of the numbers behind g: that of float or of double.
  double epsilon = 0;
};

struct LoopSolution {
  bool found = false;
  std::vector<double> x;        ///< the solution, or the best that was found
  std::vector<double> g;        ///< g(x)
  std::size_t evaluations = 0;  ///< of g
};

/// Whether x is g(x) to within rounding: |g - x| ≤ 8 ε max(|x|, |g|) + 1e-100 nominal, with 1 for
/// a nominal value that is not known.
bool has_converged(double x, double g, double nominal, double epsilon);

/// Newton's method on F(x) = g(x) - x, as in C. T. Kelley, "Solving Nonlinear Equations with
/// Newton's Method" (SIAM 2003), chapters 1 and 2:
///
/// - The Jacobian is `jacobian`, if there is one. Without one, and where it does not lead to
///   x = g(x), it comes from forward differences with the increment √ε max(|x|, |g|, nominal),
///   toward the other side where g is not finite. Central differences would take twice the
///   evaluations, each of which is a round of calls of all units in the loop, and Newton's method
///   makes up for the error of the simpler ones.
/// - The step is halved until the residual decreases sufficiently (Armijo). A g that is not finite
///   counts as an infinite residual.
/// - It ends where x has converged, or where the Newton step, an estimate of the error of x, is as
///   small as rounding allows. Where rounding stops it earlier, as behind a steep g or one that is
///   itself the result of an iteration, a Newton step of 1e-9 of x is enough.
///
/// Where the Jacobian of F is singular within its own error, or nothing decreases the residual,
/// damped fixed-point iteration x ← x + ω (g(x) - x) follows, with ω halved where the residual
/// grows. If g(guess) is not finite, the iteration starts at plus or minus the nominal values, 1
/// where there are none. The last evaluation of g is the one at the x that is returned.
LoopSolution solve_loop(const LoopFunction& g, std::vector<double> guess, const LoopScale& scale,
                        const LoopJacobian& jacobian = {});

}  // namespace stride::core

#endif
