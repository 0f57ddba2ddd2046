#include "master/engine/run/loops/loop_solver.h"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace stride::core;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

LoopSolution solve(const std::function<double(double)>& g, double guess, double nominal = 0) {
  return solve_loop(
      [&](std::span<const double> x, std::span<double> result) { result[0] = g(x[0]); }, {guess},
      {{nominal}, kEpsilon});
}

}  // namespace

TEST_CASE("linear loops of any slope but one") {
  const double slope = GENERATE(0.0, 0.5, -0.99, 0.999, -3.0, 2.0, 1e3, -1e6, 1.001);
  const double guess = GENERATE(0.0, 1.0, -1e4);
  const LoopSolution solution = solve([&](double x) { return slope * x + 4; }, guess);
  INFO("slope " << slope << ", guess " << guess);
  CHECK(solution.found);
  const double condition = std::max(1.0, std::abs(slope)) / std::abs(1 - slope);
  CHECK(solution.x[0] ==
        Approx(4 / (1 - slope)).epsilon(16 * kEpsilon * std::max(10.0, condition)));
  CHECK(solution.evaluations < 20);
}

TEST_CASE("x = cos x") {
  const double guess = GENERATE(0.0, 1.0, -40.0, 1e6);
  const LoopSolution solution = solve([](double x) { return std::cos(x); }, guess);
  CHECK(solution.found);
  CHECK(std::abs(solution.x[0] - 0.73908513321516064) < 1e-15);
}

TEST_CASE("numbers far from one need no nominal value") {
  const double size = GENERATE(1e-30, 1e-15, 1e-9, 1e12);
  const auto g = [&](double x) { return size * (2 - std::exp(x / size)); };
  // (2 - exp(z)) = z
  const LoopSolution solution = solve(g, 0);
  REQUIRE(solution.found);
  CHECK(solution.x[0] / size == Approx(0.4428544010023885).epsilon(1e-12));
}

TEST_CASE("a solution of zero is found") {
  const LoopSolution solution = solve([](double x) { return std::sinh(2 * x); }, 1);
  REQUIRE(solution.found);
  CHECK(std::abs(solution.x[0]) < 1e-30);
}

TEST_CASE("the step is shortened where it would lead too far") {
  // Newton's method on atan diverges from |x| > 1.39
  const LoopSolution solution = solve([](double x) { return x + std::atan(x - 2); }, 12);
  REQUIRE(solution.found);
  CHECK(solution.x[0] == Approx(2).epsilon(1e-12));
}

TEST_CASE("values that are not finite are avoided") {
  const auto root = [](double x) { return std::sqrt(x - 1) + 1.5; };
  // sqrt(x - 1) = x - 1.5
  const double expected = 1 + std::pow((1 + std::sqrt(3.0)) / 2, 2);
  CHECK(solve(root, 1.0).x[0] == Approx(expected).epsilon(1e-12));
  CHECK(solve(root, 100.0).x[0] == Approx(expected).epsilon(1e-12));
  const LoopSolution from_outside = solve(root, 0.0, 10);  // g(0) is NaN
  CHECK(from_outside.found);
  CHECK(from_outside.x[0] == Approx(expected).epsilon(1e-12));
}

TEST_CASE("a function with a kink is solved") {
  const LoopSolution solution = solve([](double x) { return std::abs(x - 3) - 1.5 * x; }, -5);
  REQUIRE(solution.found);
  CHECK(solution.x[0] == Approx(3 / 3.5).epsilon(1e-12));
}

TEST_CASE("a function with a step is solved") {
  const LoopSolution solution = solve([](double x) { return x < 3 ? 2.5 : 0.5 * x; }, 100);
  REQUIRE(solution.found);
  CHECK(solution.x[0] == 2.5);
}

TEST_CASE("where finite differences are zero, the damped iteration goes on") {
  // of slope one but for its small steps, which the differences do not see
  const auto g = [](double x) { return x + 0.25 * (std::floor(8 * (4 - x)) / 8); };
  const LoopSolution solution = solve(g, 0);
  REQUIRE(solution.found);
  CHECK(std::abs(solution.x[0] - 4) <= 0.125);
}

TEST_CASE("a system without a solution has no result, instead of a large number") {
  const double offset = GENERATE(1.0, -1e-3, 1e9);
  const LoopSolution solution = solve([&](double x) { return x + offset; }, 0);
  CHECK_FALSE(solution.found);
  CHECK(solution.g[0] - solution.x[0] == Approx(offset));
  CHECK_FALSE(solve([](double x) { return std::exp(x) + 1; }, 0).found);
  CHECK_FALSE(solve([](double x) { return x * x + 1; }, 0).found);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(solve([&](double) { return nan; }, 0).found);
}

TEST_CASE("random linear systems against a direct solution") {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {2u, 5u, 20u}) {
    for (int round = 0; round < 20; ++round) {
      std::vector<double> slopes(n * n), expected(n);
      for (double& value : slopes) value = 3 * normal(generator);
      for (double& value : expected) value = normal(generator) * 1e-6;
      const auto times = [&](std::span<const double> x, std::size_t row) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k) sum += slopes[row * n + k] * x[k];
        return sum;
      };
      const LoopSolution solution = solve_loop(
          [&](std::span<const double> x, std::span<double> g) {
            for (std::size_t i = 0; i < n; ++i)
              g[i] = times(x, i) + expected[i] - times(expected, i);
          },
          std::vector<double>(n), {std::vector<double>(n), kEpsilon});
      INFO(n << " unknowns, " << solution.evaluations << " evaluations");
      REQUIRE(solution.found);
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(solution.x[i] == Approx(expected[i]).epsilon(1e-9).margin(1e-15));
      }
    }
  }
}

TEST_CASE("two equations that are coupled and not linear") {
  // x = sqrt(y + 2), y = x^2 / 4 + 1: y = (y + 2) / 4 + 1, so y = 2, x = 2
  const LoopSolution solution = solve_loop(
      [](std::span<const double> x, std::span<double> g) {
        g[0] = std::sqrt(x[1] + 2);
        g[1] = x[0] * x[0] / 4 + 1;
      },
      {0, 0}, {{0, 0}, kEpsilon});
  REQUIRE(solution.found);
  CHECK(solution.x[0] == Approx(2).epsilon(1e-13));
  CHECK(solution.x[1] == Approx(2).epsilon(1e-13));
}

TEST_CASE("with a Jacobian, no evaluation is spent on differences") {
  std::vector<double> last;
  const auto g = [&](std::span<const double> x, std::span<double> result) {
    last.assign(x.begin(), x.end());
    result[0] = std::sqrt(x[1] + 2);
    result[1] = x[0] * x[0] / 4 + 1;
  };
  const auto jacobian = [&](std::span<const double> x, std::span<double> columns) {
    CHECK(last == std::vector<double>(x.begin(), x.end()));
    columns[0] = 0;
    columns[1] = x[0] / 2;
    columns[2] = 0.5 / std::sqrt(x[1] + 2);
    columns[3] = 0;
  };
  const LoopScale scale{{0, 0}, kEpsilon};
  const LoopSolution exact = solve_loop(g, {0, 0}, scale, jacobian);
  const LoopSolution differences = solve_loop(g, {0, 0}, scale);
  REQUIRE(exact.found);
  CHECK(exact.x[0] == Approx(2).epsilon(1e-15));
  CHECK(exact.x[1] == Approx(2).epsilon(1e-15));
  CHECK(2 * exact.evaluations <= differences.evaluations);
}

TEST_CASE("a Jacobian that is not finite, or wrong, does not prevent the solution") {
  const double derivative = GENERATE(std::nan(""), 1.0, 1e300, -7.0);
  const auto g = [](std::span<const double> x, std::span<double> result) {
    result[0] = std::cos(x[0]);
  };
  const auto jacobian = [&](std::span<const double>, std::span<double> columns) {
    columns[0] = derivative;
  };
  const LoopSolution solution = solve_loop(g, {0}, {{0}, kEpsilon}, jacobian);
  CHECK(solution.found);
  CHECK(solution.x[0] == Approx(0.73908513321516064).epsilon(1e-9));
}

TEST_CASE("single precision is enough for numbers of single precision") {
  const auto g = [](std::span<const double> x, std::span<double> result) {
    result[0] = static_cast<float>(-3 * static_cast<float>(x[0]) + 0.7F);
  };
  const LoopSolution solution = solve_loop(g, {0}, {{0}, std::numeric_limits<float>::epsilon()});
  CHECK(solution.found);
  CHECK(solution.x[0] == Approx(0.175).epsilon(1e-6));
}

TEST_CASE("the last evaluation is the one of the solution") {
  double last = 0;
  const LoopSolution solution = solve(
      [&](double x) {
        last = x;
        return 1 - 2 * x;
      },
      5);
  CHECK(last == solution.x[0]);
  CHECK(solution.g[0] == 1 - 2 * last);
}

TEST_CASE("noise below the required precision is tolerated") {
  std::mt19937 generator(11);  // as of a unit whose output is itself the result of an iteration
  std::uniform_real_distribution<double> noise(-1e-11, 1e-11);
  const LoopSolution solution =
      solve([&](double x) { return -2 * x + 3 * (1 + noise(generator)); }, 0);
  CHECK(solution.found);
  CHECK(solution.x[0] == Approx(1).epsilon(1e-9));
}
