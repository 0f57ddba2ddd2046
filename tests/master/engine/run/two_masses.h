// The usual benchmark of coupling methods: two masses between walls, joined by a spring, each mass
// a unit of its own that takes the other's position as its input.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_TWO_MASSES_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_TWO_MASSES_H

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/master/engine/run/scripted_system.h"

namespace stride::core {

/// m = 1 kg, wall spring k = 1 N/m, coupling spring c = 0.5 N/m. The masses start at x = 1 m and
/// 0 m, at rest: x1 = (cos(t) + cos(wt)) / 2, x2 = (cos(t) - cos(wt)) / 2, w = sqrt(1 + 2 c).
struct TwoMasses {
  static constexpr double kCoupling = 0.5;

  static double first(double t) {
    return (std::cos(t) + std::cos(std::sqrt(1 + 2 * kCoupling) * t)) / 2;
  }
  static double second(double t) {
    return (std::cos(t) - std::cos(std::sqrt(1 + 2 * kCoupling) * t)) / 2;
  }

  /// x'' = -(1 + c) x + c u, solved exactly for an input that is held.
  static StepResult move(ScriptedUnit& unit, double& velocity, Time from, Time to) {
    const double stiffness = 1 + kCoupling;
    const double w = std::sqrt(stiffness);
    const double h = to_seconds(to - from);
    const double rest = kCoupling * unit.number(0) / stiffness;
    const double x = unit.number(1) - rest;
    const double v = velocity;
    unit.number(1) = rest + x * std::cos(w * h) + v / w * std::sin(w * h);
    velocity = v * std::cos(w * h) - x * w * std::sin(w * h);
    return reached(to);
  }

  static ScriptedUnit& add(ScriptedSystem& system, const std::string& name, double position) {
    ScriptedUnit& unit =
        system.add(name, Describe("mass").input("u", "m").output("x", "m").can_save_state().done());
    const auto velocity = std::make_shared<double>(0);
    const auto saved = std::make_shared<double>(0);
    unit.number(1) = position;
    unit.on_step = [velocity](ScriptedUnit& self, Time from, Time to) {
      return move(self, *velocity, from, to);
    };
    unit.on_state = [velocity, saved](bool save) {
      (save ? *saved : *velocity) = save ? *velocity : *saved;
    };
    return unit;
  }

  explicit TwoMasses(ScriptedSystem& system) {
    add(system, "first", 1);
    add(system, "second", 0);
    system.wire("first", "x", "second", "u");
    system.wire("second", "x", "first", "u");
  }
};

/// The largest deviation from the exact solution at the communication points.
struct Deviation : Observer {
  ScriptedUnit* first;
  ScriptedUnit* second;
  double largest = 0;
  explicit Deviation(ScriptedSystem& system)
      : first(system.instances[0]), second(system.instances[1]) {}
  void on_communication_point(Time time) override {
    const double t = to_seconds(time);
    largest = std::max(largest, std::abs(first->number(1) - TwoMasses::first(t)));
    largest = std::max(largest, std::abs(second->number(1) - TwoMasses::second(t)));
  }
};

}  // namespace stride::core

#endif
