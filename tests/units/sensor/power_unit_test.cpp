#include "units/sensor/power_unit.h"

#include <cmath>
#include <cstdint>

#include <catch2/catch.hpp>

#include "tests/units/sensor/bench.h"

using sensor::Bench;
using sensor::EnergyBooks;
using sensor::ms;
using sensor::Sensor;
using sensor::SensorParameters;
using stride::Duration;
using stride::Time;

namespace {

SensorParameters without_leakage() {
  SensorParameters parameters = sensor::charged();
  parameters.power.leakage_resistance = 1e18;
  return parameters;
}

double load_power(const SensorParameters& parameters, double current) {
  return current * parameters.power.supply_voltage / parameters.power.regulator_efficiency;
}

}  // namespace

TEST_CASE("brown-out happens at the picosecond that the closed form gives") {
  SensorParameters parameters = without_leakage();
  parameters.power.initial_voltage = 4.0;
  parameters.control_unit.boot_cycles = 1'000'000'000;  // it never gets out of boot: constant load
  parameters.control_unit.clock_frequency = 1e3;
  Bench bench(parameters);

  const double c = parameters.power.capacitance;
  const double stored = c / 2 * (4.0 * 4.0 - 1.9 * 1.9);
  const double seconds = stored / load_power(parameters, 2.0e-3);
  const Time expected(Duration(static_cast<std::int64_t>(std::ceil(seconds * 1e12))));
  bench.run(expected - Duration(2));
  CHECK(bench.powered());
  bench.run(expected + Duration(2));
  CHECK_FALSE(bench.powered());
  CHECK(bench.voltage() == Approx(1.9).epsilon(1e-12));
}

TEST_CASE("a discharged sensor starts in a good field when the closed form says so") {
  SensorParameters parameters = without_leakage();
  parameters.power.initial_voltage = 0;
  Bench bench(parameters);
  bench.field(5e-3);
  const double stored = parameters.power.capacitance / 2 * 3.0 * 3.0;
  const Time expected = stride::time_from_seconds(stored / (0.5 * 5e-3));
  CHECK(stride::to_seconds(expected) < 1.0);
  bench.run(expected - Duration(2));
  CHECK_FALSE(bench.powered());
  bench.run(expected + Duration(2));
  CHECK(bench.powered());
}

TEST_CASE("power-on and brown-out have hysteresis") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 2.5;  // between the two
  Bench bench(parameters);
  bench.run(ms(10));
  CHECK_FALSE(bench.powered());
}

TEST_CASE("the energy books balance through charging, work, brown-out and recovery") {
  SensorParameters parameters;
  parameters.power.leakage_resistance = 20e3;
  Bench bench(parameters);
  const auto energy = [&] {
    return bench.read([](Sensor& s) { return s.power_unit.energy_now(); });
  };
  const double start = energy();
  const double fields[] = {6e-3, 9e-3, 0.0, 0.5e-3, 12e-3, 3e-3, 0.0, 0.0};
  int power_cycles = 0;
  bool was_powered = false;
  for (int i = 0; i < 4000; ++i) {
    bench.field(fields[(i / 250) % 8]);
    if (i % 100 == 50) bench.send({0x03, 0x01}, ms(i + 0.1));
    bench.run(ms(i + 1));
    power_cycles += static_cast<int>(bench.powered() && !was_powered);
    was_powered = bench.powered();
  }
  CHECK(power_cycles >= 2);
  const EnergyBooks books = bench.read([](Sensor& s) { return s.power_unit.books_now(); });
  CHECK(books.intake > 1e-3);
  CHECK(books.load > 1e-4);
  CHECK(books.leakage > 1e-5);
  const double balance = books.intake - books.load - books.leakage - (energy() - start);
  CHECK(std::abs(balance) < 1e-12 * books.intake + 1e-13);
}

TEST_CASE("a full capacitor takes only what is used") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 4.9;
  Bench bench(parameters);
  bench.field(20e-3);
  bench.run(ms(500));
  CHECK(bench.voltage() == Approx(5.0).epsilon(1e-12));
  const double used = bench.read([](Sensor& s) { return s.energy_load.read(); });
  const double leaked = 5.0 * 5.0 / parameters.power.leakage_resistance;
  CHECK(used == Approx(load_power(parameters, parameters.control_unit.sleep_current)));
  CHECK(bench.read([](Sensor& s) { return s.energy_intake.read(); }) == Approx(used + leaked));
  CHECK(bench.read([](Sensor& s) { return s.power_unit.charging_current_now(); }) == 0);

  bench.field(0);
  bench.run(ms(1500));
  CHECK(bench.voltage() < 5.0);
}

TEST_CASE("a field power that is no power is an error") {
  Bench bench;
  bench.field(-1e-3);
  CHECK_THROWS_WITH(bench.run(ms(1)), Catch::Matchers::Contains("field_power"));
}

TEST_CASE("the charging current is the charge's slope") {
  Bench bench;
  bench.field(8e-3);
  bench.run(ms(50));
  const auto charge = [&] {
    return bench.read([](Sensor& s) { return s.power_unit.charge_now(); });
  };
  const double current = bench.read([](Sensor& s) { return s.power_unit.charging_current_now(); });
  const double before = charge();
  bench.run(ms(50) + Duration(1'000'000));
  CHECK((charge() - before) / 1e-6 == Approx(current).epsilon(1e-4));
}
