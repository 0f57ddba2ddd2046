#include "units/environment/model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/at.h"

using environment::Parameters;
using environment::SensorCase;
using stride::Duration;
using stride::Time;

namespace {

constexpr double kPi = 3.14159265358979323846;

using stride::tests::at;

Parameters drifting() {
  Parameters p;
  p.drift_amplitude = 2.0;
  p.drift_period = 70.0;
  p.initial_temperature = 30.0;
  return p;
}

// Classical Runge-Kutta on the model's own right-hand side: a second way to the same solution.
double integrated(const SensorCase& body, double temperature, double power, double end, int steps) {
  const double h = end / steps;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const double k1 = body.temperature_rate(at(t), temperature, power);
    const double k2 = body.temperature_rate(at(t + h / 2), temperature + h / 2 * k1, power);
    const double k3 = body.temperature_rate(at(t + h / 2), temperature + h / 2 * k2, power);
    const double k4 = body.temperature_rate(at(t + h), temperature + h * k3, power);
    temperature += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return temperature;
}

}  // namespace

TEST_CASE("A case at ambient temperature that absorbs nothing stays there") {
  const SensorCase body;
  CHECK(body.temperature_after(at(0), at(1000), 21.5, 0.0) == Approx(21.5).epsilon(1e-15));
}

TEST_CASE("The rise in the steady state is power times resistance") {
  const SensorCase body;
  const double temperature = body.temperature_after(at(0), at(1e5), 21.5, 0.3);
  CHECK(temperature == Approx(21.5 + 0.3 * 20.0).epsilon(1e-14));
  CHECK(body.temperature_rate(at(0), temperature, 0.3) == Approx(0.0).margin(1e-13));
}

TEST_CASE("After one time constant the share 1 - 1/e of the way is done") {
  const SensorCase body;  // R C = 20 K/W * 5 J/K
  const double rise = body.temperature_after(at(0), at(100), 21.5, 0.5) - 21.5;
  CHECK(rise == Approx(10.0 * (1.0 - std::exp(-1.0))).epsilon(1e-13));
}

TEST_CASE("At first the case warms with power over heat capacity") {
  const SensorCase body;
  CHECK(body.temperature_rate(at(0), 21.5, 1.0) == Approx(1.0 / 5.0));
  CHECK(body.temperature_after(at(0), at(1e-3), 21.5, 1.0) - 21.5 == Approx(0.2e-3).epsilon(1e-5));
}

TEST_CASE("The ambient temperature swings around its mean") {
  const SensorCase body(drifting());
  CHECK(body.ambient_temperature(at(0)) == Approx(21.5));
  CHECK(body.ambient_temperature(at(17.5)) == Approx(23.5));
  CHECK(body.ambient_temperature(at(52.5)) == Approx(19.5));
}

TEST_CASE("The phase of the drift does not suffer from a long run") {
  const SensorCase body(drifting());
  const double early = body.ambient_temperature(at(17.123));
  const Time late = at(17.123) + 100'000 * stride::duration_from_seconds(70.0);
  CHECK(body.ambient_temperature(late) == early);
}

TEST_CASE("The exact solution agrees with a numerical integration") {
  const SensorCase body(drifting());
  const double exact = body.temperature_after(at(0), at(123), 30.0, 0.1);
  CHECK(exact == Approx(integrated(body, 30.0, 0.1, 123.0, 2000)).margin(1e-8));
}

TEST_CASE("A step may be split anywhere") {
  const SensorCase body(drifting());
  const double whole = body.temperature_after(at(0), at(50), 30.0, 0.25);
  for (const double first : {1e-12, 0.001, 7.3, 49.999'999'999}) {
    const double middle = body.temperature_after(at(0), at(first), 30.0, 0.25);
    CHECK(body.temperature_after(at(first), at(50), middle, 0.25) == Approx(whole).epsilon(1e-14));
  }
  double temperature = 30.0;
  for (int ms = 0; ms < 50'000; ++ms) {
    temperature = body.temperature_after(at(ms * 1e-3), at((ms + 1) * 1e-3), temperature, 0.25);
  }
  CHECK(temperature == Approx(whole).epsilon(1e-11));
}

TEST_CASE("A slow case follows the drift damped and late") {
  Parameters p = drifting();
  const SensorCase body(p);
  const double lag = 2.0 * kPi / p.drift_period * p.heat_capacity * p.thermal_resistance;
  double highest = -1e9;
  double temperature = body.temperature_after(at(0), at(5000), 21.5, 0.0);
  for (double t = 5000; t < 5070; t += 0.1) {
    temperature = body.temperature_after(at(t), at(t + 0.1), temperature, 0.0);
    highest = std::max(highest, temperature);
  }
  CHECK(highest - 21.5 == Approx(2.0 / std::sqrt(1.0 + lag * lag)).epsilon(1e-4));
}

TEST_CASE("The case leaves its tangent not before the promised time, and not much later") {
  const SensorCase body(drifting());
  const double tolerance = 0.01;
  int sharp = 0;
  for (double t = 0; t < 70; t += 3.5) {
    CAPTURE(t);
    const double temperature = body.temperature_after(at(0), at(t), 30.0, 0.25);
    const double rate = body.temperature_rate(at(t), temperature, 0.25);
    const auto holds = body.case_tangent_holds_for({at(t), temperature, rate, 0.25, 0}, tolerance);
    const auto error_after = [&](double seconds) {
      const double later = body.temperature_after(at(t), at(t + seconds), temperature, 0.25);
      return std::abs(later - temperature - rate * seconds);
    };
    CHECK(error_after(stride::to_seconds(holds)) <= tolerance);
    if (error_after(5 * stride::to_seconds(holds)) > tolerance) ++sharp;
  }
  CHECK(sharp > 10);  // of 20; near a point of inflection it runs straight for longer
}

TEST_CASE("Another power uses up its share of the tolerance") {
  const SensorCase body;  // R = 20 K/W, C = 5 J/K
  const double rate = body.temperature_rate(at(0), 21.5, 0.3);
  const auto holds = [&](double power, double deadband) {
    return body.case_tangent_holds_for({at(0), 21.5, rate, power, deadband}, 0.01);
  };
  CHECK(holds(0.3, 0) > holds(0.3, 1e-4));     // 2 mK of 10
  CHECK(holds(0.3, 1e-4) > holds(0.3, 1e-2));  // 0.2 K in the end, at 2 mK/s at first
  CHECK(holds(0.3, 1e-2) < Duration(5'000'000'000'000));
  CHECK(holds(0.8, 0) < Duration(100'000'000'000));  // the slope is wrong by 0.1 K/s
  CHECK(body.case_tangent_holds_for({at(0), 21.5, 0, 0, 0}, 0.01) == Duration::max());
}

TEST_CASE("The ambient temperature leaves its tangent likewise") {
  const SensorCase body(drifting());
  const double holds = stride::to_seconds(body.ambient_tangent_holds_for(0.01));
  double worst = 0;
  for (double t = 0; t < 70; t += 0.5) {
    const double tangent = body.ambient_temperature(at(t)) + body.ambient_rate(at(t)) * holds;
    worst = std::max(worst, std::abs(body.ambient_temperature(at(t + holds)) - tangent));
  }
  CHECK(worst <= 0.01);
  CHECK(worst > 0.0099);
}

TEST_CASE("A parameter out of its range is named") {
  const auto message = [](auto change) {
    Parameters p;
    change(p);
    try {
      SensorCase body(p);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(message([](auto& p) { p.heat_capacity = 0.0; }),
             Catch::Contains("case.heat_capacity") && Catch::Contains("more than 0"));
  CHECK_THAT(message([](auto& p) { p.thermal_resistance = -1.0; }),
             Catch::Contains("case.thermal_resistance"));
  CHECK_THAT(message([](auto& p) { p.drift_amplitude = -0.1; }),
             Catch::Contains("ambient.drift.amplitude"));
  CHECK_THAT(message([](auto& p) { p.drift_period = 0.0; }),
             Catch::Contains("ambient.drift.period"));
  CHECK_THAT(message([](auto& p) { p.drift_period = 1e-13; }),
             Catch::Contains("ambient.drift.period"));
  CHECK_THAT(message([](auto& p) { p.ambient_mean = -300.0; }), Catch::Contains("ambient.mean"));
  CHECK_THAT(
      message([](auto& p) { p.initial_temperature = std::numeric_limits<double>::quiet_NaN(); }),
      Catch::Contains("case.initial_temperature"));
}
