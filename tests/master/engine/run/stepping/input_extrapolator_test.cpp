#include "master/engine/run/stepping/input_extrapolator.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"
#include "tests/master/engine/run/two_masses.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

const BaseUnitOfMeasure kKelvins{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0};
const BaseUnitOfMeasure kDegrees{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15};

double deviation(Coupling coupling, Extrapolation extrapolation, Duration step) {
  ScriptedSystem system;
  TwoMasses masses(system);
  system.options.coupling = coupling;
  system.options.extrapolation = extrapolation;
  Deviation deviation(system);
  system.build(5, step).add_observer(deviation);
  system.simulation->run();
  return deviation.largest;
}

/// The exponent p of error ~ h^p, from two step sizes.
double order_of_convergence(Coupling coupling, Extrapolation extrapolation) {
  const double coarse = deviation(coupling, extrapolation, 20ms);
  const double fine = deviation(coupling, extrapolation, 5ms);
  return std::log(coarse / fine) / std::log(4);
}

/// A unit that ramps its output, and one that notes the input of each of its steps.
struct Ramp {
  ScriptedSystem system;
  std::vector<double> inputs;

  explicit Ramp(std::vector<Time> jumps = {}) {
    auto& ramp = system.add("ramp", Describe("ramp").output("y").event_mode().done());
    const auto jump = std::make_shared<double>(-100);  // the first event takes it to 0
    ramp.on_step = [jump, jumps](ScriptedUnit& self, Time, Time to) {
      self.number(0) = *jump + to_seconds(to);
      StepResult result = reached(to);
      result.event_handling_needed = std::find(jumps.begin(), jumps.end(), to) != jumps.end();
      return result;
    };
    ramp.on_event = [jump](ScriptedUnit& self) {
      *jump += 100;
      self.number(0) += 100;
      return EventResult{};
    };
    ramp.number(0) = *jump;
    auto& reader = system.add("reader", Describe("reader").input("u").done());
    reader.on_step = [this](ScriptedUnit& self, Time, Time to) {
      inputs.push_back(self.number(0));
      return reached(to);
    };
    system.wire("ramp", "y", "reader", "u");
  }
  std::vector<double> run(Coupling coupling, Extrapolation extrapolation) {
    system.options.coupling = coupling;
    system.options.extrapolation = extrapolation;
    system.build(0.005, 1ms).run();
    return inputs;
  }
};

void check_near(const std::vector<double>& values, const std::vector<double>& expected) {
  REQUIRE(values.size() == expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    CHECK(values[i] == Approx(expected[i]).epsilon(1e-9).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("inputs during a step are held, or the mean of what they are taken to become") {
  check_near(Ramp().run(Coupling::Jacobi, Extrapolation::Hold), {0, 0.001, 0.002, 0.003, 0.004});
  check_near(Ramp().run(Coupling::Jacobi, Extrapolation::Linear),
             {0, 0.0015, 0.0025, 0.0035, 0.0045});
  check_near(Ramp().run(Coupling::Jacobi, Extrapolation::Quadratic),
             {0, 0.0015, 0.0025, 0.0035, 0.0045});
}

TEST_CASE("with Gauss-Seidel a unit sees where those before it have arrived") {
  check_near(Ramp().run(Coupling::GaussSeidel, Extrapolation::Hold),
             {0.001, 0.002, 0.003, 0.004, 0.005});
  check_near(Ramp().run(Coupling::GaussSeidel, Extrapolation::Linear),
             {0.0005, 0.0015, 0.0025, 0.0035, 0.0045});
}

TEST_CASE("nothing is extrapolated across an event") {
  // the ramp jumps to 100.002 at 2 ms; what it was before says nothing of what comes
  check_near(Ramp({Time(2ms)}).run(Coupling::Jacobi, Extrapolation::Linear),
             {0, 0.0015, 100.002, 100.0035, 100.0045});
}

TEST_CASE(
    "with Gauss-Seidel, too, NaN is an error of the unit that puts it out, and reaches no other") {
  ScriptedSystem system;
  auto& source = system.add("source", Describe("source").output("y").done());
  source.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.number(0) = to > Time(2ms) ? std::nan("") : 1;
    return reached(to);
  };
  auto& reader = system.add("reader", Describe("reader").input("u").done());
  reader.on_step = [](ScriptedUnit& self, Time, Time to) {
    if (std::isnan(self.number(0))) throw std::runtime_error("it was given NaN");
    return reached(to);
  };
  system.wire("source", "y", "reader", "u");
  system.options.coupling = Coupling::GaussSeidel;
  CHECK_THROWS_WITH(
      system.build(0.005, 1ms).run(),
      Catch::Contains("unit 'source', variable 'y', at 0.003 s") && Catch::Contains("NaN"));
}

TEST_CASE("the orders of convergence of the two-mass oscillator") {
  struct Case {
    Coupling coupling;
    Extrapolation extrapolation;
    double order;
  };
  const auto c = GENERATE(Case{Coupling::Jacobi, Extrapolation::Hold, 1},
                          Case{Coupling::Jacobi, Extrapolation::Linear, 2},
                          Case{Coupling::Jacobi, Extrapolation::Quadratic, 2},
                          Case{Coupling::GaussSeidel, Extrapolation::Hold, 1},
                          Case{Coupling::GaussSeidel, Extrapolation::Linear, 2},
                          Case{Coupling::GaussSeidel, Extrapolation::Quadratic, 2});
  CAPTURE(name(c.coupling), name(c.extrapolation), deviation(c.coupling, c.extrapolation, 20ms));
  CHECK(order_of_convergence(c.coupling, c.extrapolation) == Approx(c.order).margin(0.1));
}

TEST_CASE("a step that is cut short is redone with the inputs of the shorter step") {
  const auto coupling = GENERATE(Coupling::Jacobi, Coupling::GaussSeidel);
  std::vector<std::vector<double>> inputs;
  for (const bool is_cut : {false, true}) {
    ScriptedSystem system;
    auto& ramp = system.add("ramp", Describe("ramp").output("y").can_save_state().done());
    ramp.on_step = [](ScriptedUnit& self, Time, Time to) {
      self.number(0) = to_seconds(to);
      return reached(to);
    };
    std::vector<double> seen;
    auto& reader = system.add("reader", Describe("reader").input("u").can_save_state().done());
    reader.on_step = [&](ScriptedUnit& self, Time, Time to) {
      seen.push_back(self.number(0));
      return reached(to);
    };
    auto& stopper = system.add("stopper", Describe("stopper").may_return_early().done());
    stopper.on_step = [=](ScriptedUnit&, Time from, Time to) {
      const Time stop = is_cut && from < Time(2500us) ? std::min(to, Time(2500us)) : to;
      StepResult result = reached(stop);
      result.early_return = stop < to;
      return result;
    };
    system.wire("ramp", "y", "reader", "u");
    system.options.coupling = coupling;
    system.options.extrapolation = Extrapolation::Linear;
    system.build(0.004, 1ms).run();
    inputs.push_back(seen);
  }
  check_near(inputs[0], {coupling == Coupling::Jacobi ? 0 : 0.0005, 0.0015, 0.0025, 0.0035});
  check_near(inputs[1],
             {coupling == Coupling::Jacobi ? 0 : 0.0005, 0.0015, 0.0025, 0.00225, 0.00275, 0.0035});
}

TEST_CASE("two communication points close to each other do not make a slope of a rounding error") {
  const auto extrapolation = GENERATE(Extrapolation::Linear, Extrapolation::Quadratic);
  const auto coupling = GENERATE(Coupling::Jacobi, Coupling::GaussSeidel);
  ScriptedSystem system;
  auto& sine = system.add("sine", Describe("sine").output("y").can_save_state().done());
  sine.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.number(0) = static_cast<float>(std::sin(to_seconds(to)));  // six digits are right
    return reached(to);
  };
  auto& reader = system.add("reader", Describe("reader").input("u").can_save_state().done());
  double largest = 0;
  reader.on_step = [&](ScriptedUnit& self, Time from, Time to) {
    const double middle = std::sin((to_seconds(from) + to_seconds(to)) / 2);
    largest = std::max(largest, std::abs(self.number(0) - middle));
    return reached(to);
  };
  auto& stopper = system.add("stopper", Describe("stopper").may_return_early().done());
  stopper.on_step = [](ScriptedUnit&, Time from, Time to) {  // just before each point of the grid
    const bool stops = to - from > Duration(1);
    StepResult result = reached(stops ? to - Duration(1) : to);
    result.early_return = stops;
    return result;
  };
  system.wire("sine", "y", "reader", "u");
  system.options.coupling = coupling;
  system.options.extrapolation = extrapolation;
  system.build(1, 1ms).run();
  CHECK(largest < 1e-3);  // held inputs would be off by half a step
}

TEST_CASE("steps that are rejected leave nothing behind of what was seen at their ends") {
  // from 3 ms the steps to 4, 3.5 and 3.25 ms are rejected, or 3.125 ms is where another unit has
  // an event: the accepted steps are the same
  std::vector<std::vector<double>> inputs;
  for (const bool rejects : {true, false}) {
    ScriptedSystem system;
    auto& cubic = system.add("cubic", Describe("cubic").output("y").can_save_state().done());
    cubic.on_step = [](ScriptedUnit& self, Time, Time to) {
      self.number(0) = std::pow(1e3 * to_seconds(to), 3);
      return reached(to);
    };
    auto& reader = system.add("reader", Describe("reader").input("u").can_save_state().done());
    std::vector<double> seen;
    reader.on_step = [&](ScriptedUnit& self, Time from, Time to) {
      StepResult result = reached(to);
      result.rejected = rejects && from == Time(3ms) && to > Time(3125us);
      if (!result.rejected) seen.push_back(self.number(0));
      return result;
    };
    auto& clock = system.add("clock", Describe("clock").event_mode().done());
    clock.on_event = [rejects, first = true](ScriptedUnit&) mutable {
      EventResult result;
      if (!rejects && std::exchange(first, false)) result.next_event_time = Time(3125us);
      return result;
    };
    system.wire("cubic", "y", "reader", "u");
    system.options.coupling = Coupling::GaussSeidel;
    system.options.extrapolation = Extrapolation::Quadratic;
    system.build(0.005, 1ms).run();
    CHECK(system.simulation->statistics().units[1].rejections == (rejects ? 3 : 0));
    inputs.push_back(seen);
  }
  CHECK(inputs[0] == inputs[1]);
}

TEST_CASE("an output that is another one after a step without a length counts as it is then") {
  const auto coupling = GENERATE(Coupling::Jacobi, Coupling::GaussSeidel);
  ScriptedSystem system;
  auto& source = system.add("source", Describe("source").output("y").may_return_early().done());
  source.on_step = [has_jumped = false](ScriptedUnit& self, Time from, Time to) mutable {
    const bool jumps = from == Time(2ms) && !std::exchange(has_jumped, from == Time(2ms));
    StepResult result = reached(jumps ? from : to);
    result.early_return = jumps;
    self.number(0) = jumps || from >= Time(2ms) ? 100 : 0;
    return result;
  };
  auto& reader = system.add("reader", Describe("reader").input("u").can_save_state().done());
  std::map<Time, double> seen;
  reader.on_step = [&](ScriptedUnit& self, Time from, Time to) {
    seen[from] = self.number(0);
    return reached(to);
  };
  system.wire("source", "y", "reader", "u");
  system.options.coupling = coupling;
  system.options.extrapolation = Extrapolation::Linear;
  system.build(0.005, 1ms).run();
  CHECK(seen.at(Time(3ms)) == Approx(100));
  CHECK(seen.at(Time(4ms)) == Approx(100));
}

TEST_CASE("extrapolated inputs are converted, with the offset") {
  ScriptedSystem system;
  auto& source =
      system.add("source", Describe("source").output("y", "degC").unit("degC", kDegrees).done());
  source.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.number(0) = 1e3 * to_seconds(to);
    return reached(to);
  };
  auto& reader =
      system.add("reader", Describe("reader").input("u", "K").unit("K", kKelvins).done());
  std::vector<double> seen;
  reader.on_step = [&](ScriptedUnit& self, Time, Time to) {
    seen.push_back(self.number(0));
    return reached(to);
  };
  system.wire("source", "y", "reader", "u");
  system.options.extrapolation = Extrapolation::Linear;
  system.build(0.003, 1ms).run();
  check_near(seen, {273.15, 274.65, 275.65});
}
