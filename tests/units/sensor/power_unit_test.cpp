#include "units/sensor/power_unit.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <catch2/catch.hpp>

#include "tests/units/sensor/bench.h"

using sensor::Bench;
using sensor::EnergyBooks;
using sensor::field_for;
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

double energy_error(Bench& bench) {
  return bench.read([](Sensor& s) {
    const EnergyBooks books = s.power_unit.books_now();
    return books.field - books.all_but_field_and_stored() - s.power_unit.stored_now();
  });
}

Time in(double seconds) {
  return Time(Duration(static_cast<std::int64_t>(std::ceil(seconds * 1e12))));
}

}  // namespace

TEST_CASE("brown-out happens at the picosecond that the closed form gives") {
  SensorParameters parameters = without_leakage();
  parameters.power.initial_voltage = 4.0;
  parameters.control_unit.boot_cycles = 1'000'000'000;  // it never gets out of boot: constant load
  parameters.control_unit.clock_frequency = 1e3;
  Bench bench(parameters);
  bench.field(0);

  const double drop = 2.0e-3 * parameters.power.series_resistance;
  const double seconds = parameters.power.capacitance * (4.0 - drop - 1.9) / 2.0e-3;
  bench.run(in(seconds)-Duration(2));
  CHECK(bench.powered());
  CHECK(bench.voltage() == Approx(1.9).epsilon(1e-9));
  bench.run(in(seconds) + Duration(2));
  CHECK_FALSE(bench.powered());
  CHECK(bench.voltage() == Approx(1.9 + drop).epsilon(1e-12));  // the drop is gone with the load
}

TEST_CASE("a discharged sensor starts in a good field when the closed form says so") {
  SensorParameters parameters = without_leakage();
  parameters.power.initial_voltage = 0;
  Bench bench(parameters);
  const double current = 0.5e-3;
  bench.field(field_for(parameters.power, current));
  const double drop = current * parameters.power.series_resistance;
  const double charged = parameters.power.capacitance * (3.0 - drop) / current;
  CHECK(charged < 1.0);
  const Time expected = in(charged) + stride::duration_from_seconds(1e-3);  // the delay
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

TEST_CASE("a capacitor with a large resistance may not get the device through its boot") {
  SensorParameters parameters = without_leakage();
  parameters.power.initial_voltage = 0;
  parameters.power.series_resistance = 1000;  // 2 mA of the control unit make 2 V
  // a boot takes 15 mV from the capacitor, the delay before it gives 10 mV, or 25 mV
  const double delay = GENERATE(2e-3, 5e-3);
  parameters.power.start_up_delay = delay;
  Bench bench(parameters);
  bench.field(field_for(parameters.power, 0.5e-3));
  bench.run(ms(1200));
  CHECK(bench.read([](Sensor& s) { return s.power_unit.books_now().parts[0]; }) > 1e-6);
  CHECK((bench.voltage() > 4) == (delay > 3e-3));
  CHECK(std::abs(energy_error(bench)) < 1e-15);
}

TEST_CASE("energy is conserved to rounding at every instant, whatever happens") {
  SensorParameters parameters;
  parameters.power.leakage_resistance = 20e3;
  parameters.power.capacitance = 40e-6;
  Bench bench(parameters);
  std::mt19937 random(4);  // its sequence is part of the C++ standard
  const double fields[] = {0.0, 0.15e-3, 0.25e-3, 6e-3, 9e-3, 15e-3, 150e-3};
  int power_cycles = 0;
  bool was_powered = false;
  Time now;
  for (int i = 0; i < 5000; ++i) {
    if (random() % 40 == 0) bench.field(fields[random() % 7]);
    if (random() % 10 == 0) bench.arrive(sensor::request({0x03, random() % 2 == 0}, now));
    if (random() % 20 == 0) bench.arrive(sensor::request({0x02}, now));
    now += Duration(1 + random() % 2'000'000'000);
    bench.run(now);
    power_cycles += static_cast<int>(bench.powered() && !was_powered);
    was_powered = bench.powered();
    const double taken = bench.read([](Sensor& s) { return s.power_unit.books_now().field; });
    REQUIRE(std::abs(energy_error(bench)) < 1e-12 * taken + 1e-17);
  }
  CHECK(power_cycles >= 3);
  const EnergyBooks books = bench.read([](Sensor& s) { return s.power_unit.books_now(); });
  for (const double loss : {books.rectifier, books.limiter, books.charger, books.series_resistance,
                            books.leakage, books.regulator}) {
    CHECK(loss > 1e-6);
  }
  for (const double used : books.parts) CHECK(used > 1e-8);
}

TEST_CASE("in the field the rail jumps to the maximum voltage, and the charge follows") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 3.5;
  Bench bench(parameters);
  bench.run(ms(50));
  const auto rail = [&] {
    return bench.read([](Sensor& s) { return s.power_unit.rail_voltage_now(); });
  };
  CHECK(rail() < 3.5);
  bench.field(5e-3);
  bench.run(ms(50));
  CHECK(rail() == 5.0);
  CHECK(bench.read([](Sensor& s) { return s.voltage.read(); }) == 5.0);
  CHECK(bench.voltage() < 3.6);
  bench.run(ms(150));
  CHECK(bench.voltage() > 3.8);
  bench.field(0);
  bench.run(ms(150));
  CHECK(rail() == bench.voltage());
}

TEST_CASE("a full capacitor takes only what is used") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 4.9;
  Bench bench(parameters);
  bench.field(20e-3);
  bench.run(ms(2000));
  CHECK(bench.voltage() == 5.0);
  const double used = bench.read([](Sensor& s) { return s.power_unit.load_now(); });
  const double leaked = 5.0 * 5.0 / parameters.power.leakage_resistance;
  CHECK(used == Approx(parameters.control_unit.sleep_current * 5.0));
  CHECK(bench.read([](Sensor& s) { return s.power_unit.intake_now(); }) == Approx(used + leaked));
  CHECK(std::abs(bench.read([](Sensor& s) { return s.power_unit.rates_now().charge; })) < 1e-12);

  bench.field(0);
  bench.run(ms(3000));
  CHECK(bench.voltage() < 5.0);
}

TEST_CASE("a leak that takes more than the charger gives lets a full capacitor sink") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 5.0;
  parameters.power.leakage_resistance = 10e3;  // 0.5 mA at 5 V
  Bench bench(parameters);
  bench.field(field_for(parameters.power, 0.4e-3));
  bench.run(ms(100));
  CHECK(bench.voltage() < 5.0);
  bench.run(ms(60'000));
  CHECK(bench.voltage() == Approx(0.398e-3 * (10e3 + 100)).epsilon(1e-6));
  CHECK(std::abs(energy_error(bench)) < 1e-12);
}

TEST_CASE("a field power that is no power is an error") {
  Bench bench;
  bench.field(-1e-3);
  CHECK_THROWS_WITH(bench.run(ms(1)), Catch::Matchers::Contains("field_power"));
}

TEST_CASE("the README's figures are those of the default sensor") {
  Bench empty{SensorParameters()};
  empty.field(5e-3);
  empty.run(ms(490));
  CHECK_FALSE(empty.powered());
  empty.run(ms(540));
  CHECK(empty.powered());
  empty.run(ms(900));
  CHECK(empty.voltage() > 4.9);

  SensorParameters full;
  full.power.initial_voltage = 5.0;
  Bench sleeping(full);
  sleeping.field(0);
  sleeping.run(ms(110'000));
  CHECK(sleeping.powered());
  sleeping.run(ms(140'000));
  CHECK_FALSE(sleeping.powered());

  Bench lit(full);
  lit.ask({0x03, 1}, ms(5));
  CHECK(lit.led());
  lit.run(ms(250));
  CHECK(lit.led());
  lit.run(ms(350));
  CHECK_FALSE(lit.led());
}

TEST_CASE("the rates are the slopes") {
  for (const double field : {0.0, 0.19e-3, 0.5e-3, 8e-3, 80e-3}) {
    SensorParameters parameters;
    parameters.power.initial_voltage = 4.0;
    Bench bench(parameters);
    bench.field(field);
    bench.run(ms(20));
    const auto values = [&] {
      return bench.read([](Sensor& s) { return s.power_unit.readings_now(); });
    };
    const auto rates = bench.read([](Sensor& s) { return s.power_unit.rates_now(); });
    const auto before = values();
    bench.run(ms(20) + Duration(10'000'000));
    auto slopes = values();
    sensor::visit_pairs(slopes, before,
                        [](double& after, double start) { after = (after - start) / 1e-5; });
    CAPTURE(field);
    sensor::visit_pairs(slopes, rates, [](double slope, double rate) {
      CHECK(slope == Approx(rate).epsilon(2e-3).margin(1e-9));
    });
  }
}
