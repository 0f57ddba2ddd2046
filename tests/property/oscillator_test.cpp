// Two masses, a unit each: how fast the error of a coupling method falls with the step.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/property/assembly.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using core::Coupling;
using core::Extrapolation;

namespace {

/// m = 1 kg, k = 10 N/m to the ground, 5 N/m between the masses, no damping; the first is let go at
/// 1 m, both with this velocity [m/s]. The modes have the angular frequencies sqrt(10) and
/// sqrt(20) 1/s; the velocity is all in the slow one.
struct Oscillator {
  double velocity = 0;

  Assembly assembly() const {
    const Assembly::Values undamped{{"damping", "0"}, {"coupling_damping", "0"}};
    Assembly system;
    system.add("first", "oscillator_mass", undamped).add("second", "oscillator_mass", undamped);
    system.set("first.start_displacement", "1").set("second.start_displacement", "0");
    system.set("first.start_velocity", std::to_string(velocity));
    system.set("second.start_velocity", std::to_string(velocity));
    system.wire("first.x", "second.x_other").wire("first.v", "second.v_other");
    system.wire("second.x", "first.x_other").wire("second.v", "first.v_other");
    return system;
  }

  /// The largest deviation of a displacement from the closed form.
  double deviation(const Results& results) const {
    double largest = 0;
    for (const auto& [time, values] : results.values) {
      const double t = to_seconds(time);
      const double w = std::sqrt(10.0);
      const double slow = std::cos(w * t) / 2 + velocity / w * std::sin(w * t);
      const double fast = std::cos(std::sqrt(20.0) * t) / 2;
      largest = std::max(largest, std::abs(results.value(time, "first.x") - (slow + fast)));
      largest = std::max(largest, std::abs(results.value(time, "second.x") - (slow - fast)));
    }
    return largest;
  }
};

double deviation(Coupling coupling, Extrapolation extrapolation, Duration step,
                 const Oscillator& oscillator = {}) {
  core::RunOptions options = fixed_steps(step, Time(2s));
  options.coupling = coupling;
  options.extrapolation = extrapolation;
  return oscillator.deviation(run(oscillator.assembly(), options));
}

/// With quadratic extrapolation and error-controlled steps.
Results controlled(const Oscillator& oscillator, double tolerance) {
  core::RunOptions options = fixed_steps(10ms, Time(2s));
  options.step.policy = &core::kErrorControlledSteps;
  options.step.relative_tolerance = 0;
  options.step.absolute_tolerance = tolerance;
  options.extrapolation = Extrapolation::Quadratic;
  return run(oscillator.assembly(), options);
}

}  // namespace

TEST_CASE("units that request inputs within a step gain an order for each degree") {
  struct Case {
    Coupling coupling;
    Extrapolation extrapolation;
    double order;
  };
  const auto c = GENERATE(Case{Coupling::Jacobi, Extrapolation::Hold, 1},
                          Case{Coupling::Jacobi, Extrapolation::Linear, 2},
                          Case{Coupling::Jacobi, Extrapolation::Quadratic, 3},
                          Case{Coupling::GaussSeidel, Extrapolation::Hold, 1},
                          Case{Coupling::GaussSeidel, Extrapolation::Linear, 2},
                          Case{Coupling::GaussSeidel, Extrapolation::Quadratic, 3});
  const double coarse = deviation(c.coupling, c.extrapolation, 8ms);
  const double fine = deviation(c.coupling, c.extrapolation, 2ms);
  CAPTURE(name(c.coupling), name(c.extrapolation), coarse, fine);
  CHECK(std::log(coarse / fine) / std::log(4) == Approx(c.order).margin(0.15));
}

TEST_CASE("the first step, without a history, makes quadratic extrapolation one of second order") {
  const auto coupling = GENERATE(Coupling::Jacobi, Coupling::GaussSeidel);
  const Oscillator moving{2};
  const double coarse = deviation(coupling, Extrapolation::Quadratic, 8ms, moving);
  const double fine = deviation(coupling, Extrapolation::Quadratic, 2ms, moving);
  CAPTURE(name(coupling), coarse, fine);
  CHECK(std::log(coarse / fine) / std::log(4) == Approx(2).margin(0.25));
}

TEST_CASE("error-controlled steps begin short enough to be of third order from motion, too") {
  const Oscillator oscillator{GENERATE(0.0, 2.0)};
  const Results coarse = controlled(oscillator, 1e-4);
  const Results fine = controlled(oscillator, 1e-7);
  const auto steps = [](const Results& results) {
    return static_cast<double>(results.statistics.communication_steps);
  };
  const double gain = oscillator.deviation(coarse) / oscillator.deviation(fine);
  CAPTURE(oscillator.velocity, steps(coarse), steps(fine), gain);
  CHECK(std::log(gain) / std::log(steps(fine) / steps(coarse)) > 2.7);
}

TEST_CASE("the error-controlled oscillator gets as accurate as required") {
  const Oscillator oscillator;
  double last = 1;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const Results results = controlled(oscillator, tolerance);
    CAPTURE(tolerance, results.statistics.communication_steps, results.statistics.undone_steps);
    const double error = oscillator.deviation(results);
    CHECK(error < 20 * tolerance);
    CHECK(error < last / 3);
    last = error;
  }
}
