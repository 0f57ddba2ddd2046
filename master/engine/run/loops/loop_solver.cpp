#include "master/engine/run/loops/loop_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>

namespace stride::core {
namespace {

constexpr int kMostNewtonSteps = 50;
constexpr int kMostHalvings = 12;
constexpr int kMostDampedSteps = 200;
constexpr double kSufficientDecrease = 1e-4;
constexpr double kGoodStep = 1e-9;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

std::span<const double> view(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

std::vector<double> to_std(const Vector& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

class Solver {
 public:
  Solver(const LoopFunction& function, std::vector<double> guess, const LoopScale& scale,
         const LoopJacobian& jacobian)
      : function_(function),
        jacobian_(jacobian),
        nominals_(Eigen::Map<const Vector>(scale.nominals.data(),
                                           static_cast<Eigen::Index>(scale.nominals.size()))),
        epsilon_(scale.epsilon),
        guess_(Eigen::Map<const Vector>(guess.data(), static_cast<Eigen::Index>(guess.size()))) {}

  LoopSolution run() {
    start();
    const Point first = now_;
    if (first.is_finite() && newton()) return result(true);
    const Point best = now_;
    now_ = first;
    if (first.is_finite() && damped()) return result(true);
    if (best.is_finite() && norm(best) <= norm(now_)) now_ = best;
    return result(false);
  }

 private:
  struct Point {
    Vector x, g;
    bool is_finite() const { return x.allFinite() && g.allFinite(); }
  };

  Point evaluate(Vector x) {
    Point point{std::move(x), Vector(guess_.size())};
    function_(view(point.x), {point.g.data(), static_cast<std::size_t>(point.g.size())});
    ++evaluations_;
    last_x_ = point.x;
    return point;
  }

  void start() {
    now_ = evaluate(guess_);
    const Vector ones = (nominals_.array() > 0).select(nominals_, 1.0);
    for (const double sign : {1.0, -1.0}) {
      if (now_.is_finite()) return;
      const Point other = evaluate(sign * ones);
      if (other.is_finite()) now_ = other;
    }
  }

  bool has_converged() const {
    for (Eigen::Index i = 0; i < now_.x.size(); ++i) {
      if (!core::has_converged(now_.x[i], now_.g[i], nominals_[i], epsilon_)) return false;
    }
    return true;
  }

  /// The magnitude of each unknown.
  Vector scale() const {
    const Vector size = now_.x.cwiseAbs().cwiseMax(now_.g.cwiseAbs()).cwiseMax(nominals_);
    return (size.array() > 0).select(size, 1.0);
  }

  double norm(const Point& point) const {
    return (point.g - point.x).cwiseQuotient(scale_).stableNorm();
  }

  bool newton() {
    if (jacobian_ && newton(&Solver::derivatives, false)) return true;
    return newton(&Solver::differences, true);
  }

  /// A small step means that x is near the solution only if the Jacobian is accurate.
  bool newton(std::optional<Matrix> (Solver::*jacobian)(), bool is_believed) {
    for (int i = 0; i < kMostNewtonSteps; ++i) {
      if (has_converged()) return true;
      scale_ = scale();
      const auto step = newton_step((this->*jacobian)());
      if (!step) return false;
      const double size = step->cwiseQuotient(scale_).lpNorm<Eigen::Infinity>();
      if (size <= 2 * epsilon_) return is_believed;
      if (!search(*step)) return is_believed && size <= kGoodStep;
    }
    return false;
  }

  /// Nothing where the Jacobian is singular.
  std::optional<Vector> newton_step(const std::optional<Matrix>& jacobian) {
    if (!jacobian) return std::nullopt;
    const Eigen::Index n = now_.x.size();
    const Eigen::ColPivHouseholderQR<Matrix> qr(Matrix::Identity(n, n) - *jacobian);
    const double error = 64 * std::sqrt(epsilon_);  // of a difference, generously
    if (qr.matrixR().diagonal().cwiseAbs().minCoeff() <= error) return std::nullopt;
    const Vector step = qr.solve((now_.g - now_.x).cwiseQuotient(scale_)).cwiseProduct(scale_);
    return step.allFinite() ? std::optional(step) : std::nullopt;
  }

  /// Of g, between unknowns divided by their scales; nothing where it is not finite.
  std::optional<Matrix> derivatives() {
    if (last_x_ != now_.x) now_ = evaluate(now_.x);
    const Eigen::Index n = now_.x.size();
    Matrix jacobian(n, n);
    jacobian_(view(now_.x), {jacobian.data(), static_cast<std::size_t>(jacobian.size())});
    jacobian = scale_.cwiseInverse().asDiagonal() * jacobian * scale_.asDiagonal();
    return jacobian.allFinite() ? std::optional(jacobian) : std::nullopt;
  }

  std::optional<Matrix> differences() {
    const Eigen::Index n = now_.x.size();
    Matrix jacobian(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto column = difference(i);
      if (!column) return std::nullopt;
      jacobian.col(i) = *column;
    }
    return jacobian;
  }

  std::optional<Vector> difference(Eigen::Index i) {
    const double increment = std::sqrt(epsilon_) * scale_[i];
    for (const double wanted :
         {std::copysign(increment, now_.x[i]), -std::copysign(increment, now_.x[i])}) {
      Vector x = now_.x;
      x[i] += wanted;
      const double exact = x[i] - now_.x[i];  // as the sum was rounded
      const Point other = evaluate(std::move(x));
      if (!other.is_finite()) continue;
      return (other.g - now_.g).cwiseQuotient(scale_) * (scale_[i] / exact);
    }
    return std::nullopt;
  }

  /// Goes along the step as far as it is good; false if it is not good at all.
  bool search(const Vector& step) {
    const double before = norm(now_);
    double share = 1;
    for (int i = 0; i <= kMostHalvings; ++i, share /= 2) {
      Point trial = evaluate(now_.x + share * step);
      if (!trial.is_finite()) continue;
      if (norm(trial) > (1 - kSufficientDecrease * share) * before) continue;
      now_ = std::move(trial);
      return true;
    }
    return false;
  }

  bool damped() {
    double share = 0.5;
    for (int i = 0; i < kMostDampedSteps; ++i) {
      if (has_converged()) return true;
      scale_ = scale();
      const double before = norm(now_);
      Point next = evaluate(now_.x + share * (now_.g - now_.x));
      const double after = next.is_finite() ? norm(next) : std::numeric_limits<double>::infinity();
      if (after != before) share = after < before ? std::min(1.0, 1.5 * share) : share / 2;
      if (next.is_finite()) now_ = std::move(next);
    }
    return has_converged();
  }

  LoopSolution result(bool found) {
    if (last_x_ != now_.x) now_ = evaluate(now_.x);
    return {found, to_std(now_.x), to_std(now_.g), evaluations_};
  }

  const LoopFunction& function_;
  const LoopJacobian& jacobian_;
  Vector nominals_;
  double epsilon_;
  Vector guess_;
  Vector scale_ = Vector::Ones(guess_.size());
  Point now_;
  Vector last_x_;
  std::size_t evaluations_ = 0;
};

}  // namespace

bool has_converged(double x, double g, double nominal, double epsilon) {
  if (x == g) return true;
  constexpr double kNegligible = 1e-100;
  const double tolerance =
      8 * epsilon * std::max(std::abs(x), std::abs(g)) + kNegligible * (nominal > 0 ? nominal : 1);
  return std::abs(g - x) <= tolerance;
}

LoopSolution solve_loop(const LoopFunction& g, std::vector<double> guess, const LoopScale& scale,
                        const LoopJacobian& jacobian) {
  return Solver(g, std::move(guess), scale, jacobian).run();
}

}  // namespace stride::core
