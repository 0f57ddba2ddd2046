// One mass of a symmetric oscillator whose other mass moves as the closed form says: in opposite
// phase, x_other = -x, so that m a = -(k + 2 kc) x and x = cos(w t) without damping.
#include <chrono>
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/unit_capabilities.h"
#include "tests/physics/fmu_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr double kFrequency = 4.47213595499958;  // sqrt(10 + 2 * 5)
constexpr Duration kEnd = 1s;

/// How x(1 s) differs from the closed form, with inputs that are right at the beginning of each
/// step, or all the time.
double error(Duration step, const std::string& largest_step, bool follows) {
  const auto loaded = importer::Fmu::load(test_fmu("oscillator_mass"));
  const core::UnitDescription& description = *loaded->description();
  importer::InstanceOptions options;
  options.intermediate_update = follows;
  const auto unit = loaded->instantiate("mass", options);
  const auto variable = [&](const std::string& name) -> const core::Variable& {
    return description.variables[*description.find(name)];
  };
  const auto set = [&](const std::string& name, const core::ValueBlock& value) {
    unit->set(std::span(&variable(name).reference, 1), value);
  };
  core::ValueBlock number(core::ValueType::Float64, 1);
  double& value = number.numbers<double>()[0];
  const auto set_inputs = [&](double time) {
    value = -std::cos(kFrequency * time);
    set("x_other", number);
    value = kFrequency * std::sin(kFrequency * time);
    set("v_other", number);
  };
  for (const char* none : {"damping", "coupling_damping"}) {
    set(none, core::parse(variable(none), "0"));
  }
  set("largest_step", core::parse(variable("largest_step"), largest_step));
  unit->enter_initialization({}, std::nullopt);
  unit->exit_initialization();
  unit->update_discrete_states();
  unit->enter_step_mode();
  Time now{};
  inputs_within_step(*unit).set_input_update(
      [&](double seconds) { set_inputs(to_seconds(now) + seconds); });
  for (; now < Time(kEnd); now += step) {
    set_inputs(to_seconds(now));
    unit->step({now, now + step});
  }
  unit->get(std::span(&variable("x").reference, 1), number);
  return std::abs(value - std::cos(kFrequency * to_seconds(kEnd)));
}

}  // namespace

TEST_CASE(
    "with inputs that follow within the step it converges as its solver, with the fourth order") {
  const double coarse = error(100ms, "0.05", true);
  const double fine = error(100ms, "0.025", true);
  CHECK(coarse < 1e-3);
  CHECK(std::log2(coarse / fine) == Approx(4).margin(0.2));
  CHECK(error(100ms, "0.0005", true) < 1e-11);
}

TEST_CASE("with inputs that are held the communication step alone decides, with the first order") {
  const double coarse = error(20ms, "0.0005", false);
  const double fine = error(10ms, "0.0005", false);
  CHECK(coarse > 5e-3);
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.1));
  CHECK(error(20ms, "0.00025", false) == Approx(coarse).epsilon(1e-3));
}
