// Sampled control of a low-pass, T dy/dt = u - y, which is exact for the u that is held between two
// ticks. At tick k, with the period h and a = exp(-h / T):
//
//   y[k+1] = a y[k] + (1 - a) u[k]
#include <algorithm>
#include <chrono>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/physics/fmu_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr double kTimeConstant = 0.05;
constexpr double kGain = 1.5;

void add_plant(FmuSystem& system) {
  system.add("plant", fmu("minimal"), {{"time_constant", std::to_string(kTimeConstant)}});
  system.wire("controller", "u", "plant", "u");
  system.wire("plant", "y", "controller", "y");
}

/// The place of the communication point at this time.
std::size_t point_at(const Record& record, double time) {
  for (std::size_t i = 0; i < record.times.size(); ++i) {
    if (record.times[i] == time) return i;
  }
  FAIL("no communication point at " << time << " s");
  return 0;
}

/// With u = gain (r - y): y[k] = y_end (1 - lambda^k), y_end = gain r / (1 + gain),
/// lambda = a - (1 - a) gain.
double proportional(double period, int k) {
  const double a = std::exp(-period / kTimeConstant);
  return kGain / (1 + kGain) * (1 - std::pow(a - (1 - a) * kGain, k));
}

/// Compares with it at tick k, at shift + k period, each time rounded to the picosecond.
void check_proportional(const Record& record, double shift, double period, int ticks) {
  for (int k = 0; k < ticks; ++k) {
    const std::size_t i = point_at(record, to_seconds(duration_from_seconds(shift + k * period)));
    CAPTURE(k, record.times[i]);
    CHECK(record.values.at("plant.y")[i] == Approx(proportional(period, k)).margin(1e-13));
    const double u = kGain * (1 - record.values.at("plant.y")[i]);
    CHECK(record.values.at("controller.u")[i] == Approx(u).margin(1e-15));
    CHECK(record.values.at("controller.last_tick")[i] == record.times[i]);
  }
  CHECK(record.values.at("controller.ticks").back() == ticks);
}

}  // namespace

TEST_CASE("proportional control on a constant clock follows the closed form") {
  const Duration step = GENERATE(Duration(1ms), Duration(2ms), Duration(7ms), Duration(1s));
  FmuSystem system;
  system.add("controller", test_fmu("periodic_controller"),
             {{"gain", std::to_string(kGain)}, {"reset_time", "1e300"}, {"r", "1"}});
  add_plant(system);
  const Record record = system.run(
      500ms, step, {"plant.y", "controller.u", "controller.ticks", "controller.last_tick"});
  check_proportional(record, 0.002, 0.01, 50);
}

TEST_CASE("a controller on a countdown clock follows a period that is not a decimal") {
  // as picoseconds: what the unit counts down
  const double period = to_seconds(duration_from_seconds(std::sqrt(2.0) * 3e-3));
  const Duration step = GENERATE(Duration(1ms), Duration(1s));
  FmuSystem system;
  system.add("plant", fmu("minimal"), {{"time_constant", std::to_string(kTimeConstant)}});
  system.add("controller", test_fmu("sampled_controller"),
             {{"gain", std::to_string(kGain)},
              {"reset_time", "1e300"},
              {"r", "1"},
              {"period", "0.004242640687119285"}});
  system.wire("controller", "u", "plant", "u");
  system.wire("plant", "y", "controller", "y");
  const Record record = system.run(
      500ms, step, {"plant.y", "controller.u", "controller.ticks", "controller.last_tick"});
  check_proportional(record, 0, period, 118);
}

TEST_CASE("PI control follows its difference equation") {
  constexpr double kPeriod = 0.01;
  constexpr double kResetTime = 0.04;
  FmuSystem system;
  system.add("controller", test_fmu("periodic_controller"),
             {{"gain", std::to_string(kGain)}, {"reset_time", "0.04"}, {"r", "1"}});
  add_plant(system);
  const Record record = system.run(1s, 3ms, {"plant.y", "controller.u"});
  const double a = std::exp(-kPeriod / kTimeConstant);
  double y = 0;
  double integral = 0;
  for (int k = 0; k < 100; ++k) {
    const std::size_t i = point_at(record, to_seconds(duration_from_seconds(0.002 + k * kPeriod)));
    const double u = kGain * (1 - y) + integral;
    CAPTURE(k);
    CHECK(record.values.at("plant.y")[i] == Approx(y).margin(1e-12));
    CHECK(record.values.at("controller.u")[i] == Approx(u).margin(1e-12));
    integral += kGain * kPeriod / kResetTime * (1 - y);
    y = a * y + (1 - a) * u;
  }
  CHECK(y == Approx(1).margin(1e-9));
}

TEST_CASE("a period that changes while it runs counts from its change") {
  FmuSystem system;
  auto& schedule = system.add("schedule", core::Describe("schedule").output("period").done());
  schedule.on_initialize = [](core::ScriptedUnit& unit) { unit.number(0) = 0.004; };
  schedule.on_step = [](core::ScriptedUnit& unit, Time, Time to) {
    if (to >= Time(10ms)) unit.number(0) = 0.0025;
    if (to >= Time(16ms)) unit.number(0) = 0.01;
    core::StepResult result;
    result.reached = to;
    return result;
  };
  system.add("controller", test_fmu("sampled_controller"), {{"shift", "0.001"}});
  system.wire("schedule", "period", "controller", "period");
  const Record record = system.run(30ms, 1ms, {"controller.last_tick"});
  std::vector<double> ticks = record.values.at("controller.last_tick");
  ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
  CHECK(ticks == std::vector<double>{-1, 0.001, 0.005, 0.009, 0.0125, 0.015, 0.026});
}

TEST_CASE("each kind of clock ticks at its declared times") {
  FmuSystem system;
  auto& button =
      system.add("button", core::Describe("button")
                               .add("pressed", core::ValueType::Boolean, core::Causality::Output)
                               .done());
  button.on_step = [](core::ScriptedUnit& unit, Time, Time to) {
    unit.clock(0) = to >= Time(9ms);
    core::StepResult result;
    result.reached = to;
    return result;
  };
  system.add("clocks", test_fmu("clocks"));
  system.wire("button", "pressed", "clocks", "start");
  std::vector<std::string> recorded;
  const std::map<std::string, std::pair<int, double>> expected = {
      {"constant", {7, 0.019}},         // 1 ms, 4 ms, …
      {"fixed", {5, 0.02}},             // 0, 5 ms, …
      {"fixed_by_unit", {10, 0.0185}},  // 0.5 ms, 2.5 ms, …
      {"tunable", {3, 0.0145}},         // 0.5 ms, 7.5 ms, …
      {"tunable_by_unit", {10, 0.0185}},
      {"changing", {5, 0.015}},   // 1, 3, 6, 10, 15 ms
      {"countdown", {1, 0.013}},  // 4 ms after the button
      {"triggered", {0, -1}},
  };
  for (const auto& [name, value] : expected) {
    recorded.push_back("clocks." + name + ".ticks");
    recorded.push_back("clocks." + name + ".last");
  }
  const Record record = system.run(20ms, 1ms, recorded);
  for (const auto& [name, value] : expected) {
    CAPTURE(name);
    CHECK(record.values.at("clocks." + name + ".ticks").back() == value.first);
    CHECK(record.values.at("clocks." + name + ".last").back() == value.second);
  }
}

TEST_CASE("a clock may tick several times at one instant") {
  FmuSystem system;
  system.add("clocks", test_fmu("clocks"), {{"echoes", "2"}});
  const Record record = system.run(20ms, 5ms, {"clocks.changing.ticks", "clocks.changing.last"});
  // three times at 1, 5 and 12 ms
  CHECK(record.values.at("clocks.changing.ticks").back() == 9);
  CHECK(record.values.at("clocks.changing.last").back() == 0.012);
}
