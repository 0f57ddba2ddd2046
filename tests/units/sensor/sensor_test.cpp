#include "units/sensor/sensor.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/sensor/bench.h"

using nfc::Bytes;
using sensor::Bench;
using sensor::data_of;
using sensor::ms;
using sensor::Sensor;
using sensor::SensorParameters;
using stride::Duration;
using stride::Time;

namespace {

Bytes answer_to(const Bytes& command, double temperature = 20) {
  Bench bench;
  bench.temperature(temperature);
  bench.send(command, ms(5));
  bench.run(ms(10));
  REQUIRE(bench.answers.size() == 1);
  return data_of(bench.answers[0]).value();
}

/// What a run leaves behind.
struct StepRecord {
  std::vector<nfc::Frame> answers;
  double charge = 0;
  int received = 0;

  bool operator==(const StepRecord& other) const {
    return answers == other.answers && charge == other.charge && received == other.received;
  }
};

/// 300 ms with a changing field and some commands, cut into steps by `next`, which is given an
/// instant and returns a later one. Inputs change at whole multiples of 10 ms only.
template <class Next>
StepRecord run_in_steps(const SensorParameters& parameters, Next next) {
  Bench bench(parameters);
  for (const double start : {12.3456, 57.1, 61.7, 123.456789, 280.0}) {
    bench.send({0x02}, ms(start));
  }
  bench.send({0x03, 0x01}, ms(130));
  Time now;
  for (int i = 0; i < 30; ++i) {
    bench.field(i % 7 == 0 ? 6e-3 : i % 7 < 4 ? 0.0 : 1.5e-3);
    bench.temperature(20 + i);
    for (const Time end = ms(10 * (i + 1)); now < end;) {
      now = std::min(end, next(now));
      bench.run(now);
    }
  }
  return {bench.answers, bench.read([](Sensor& s) { return s.power_unit.charge_now(); }),
          bench.frames().received};
}

}  // namespace

TEST_CASE("the ADC's whole range is answered") {
  CHECK(answer_to({0x02}, -40) == Bytes{0x00, 0xF0, 0x60});   // -4000
  CHECK(answer_to({0x02}, 125) == Bytes{0x00, 0x30, 0xD4});   // 12500
  CHECK(answer_to({0x02}, 1000) == Bytes{0x00, 0x30, 0xD4});  // saturated
}

TEST_CASE("the temperature is that of the conversion") {
  Bench bench;
  bench.send({0x02}, ms(5));
  bench.temperature(30);
  bench.run(ms(10));
  bench.temperature(50);
  bench.run(ms(20));
  REQUIRE(bench.answers.size() == 1);
  const Bytes data = data_of(bench.answers[0]).value();
  CHECK((data[1] << 8 | data[2]) / 100.0 == Approx(30).margin(0.03));
  CHECK(bench.read([](Sensor& s) { return s.adc_code.read(); }) ==
        sensor::to_code(sensor::AdcParameters(), 30));
}

TEST_CASE("the LED obeys and draws its current") {
  Bench bench;
  const auto load = [&] {
    return bench.read(
        [](Sensor& s) { return s.power_unit.load_now() / s.power_unit.rail_voltage_now(); });
  };
  bench.run(ms(5));
  const double dark = load();
  bench.send({0x03, 0x01}, ms(5));
  bench.run(ms(10));
  CHECK(bench.led());
  CHECK(load() - dark == Approx(1.0e-3));
  bench.send({0x03, 0x00}, ms(10));
  bench.run(ms(15));
  CHECK_FALSE(bench.led());
  CHECK(load() == Approx(dark));
}

TEST_CASE("commands are executed in the order of their arrival") {
  SensorParameters parameters = sensor::charged();
  parameters.control_unit.boot_cycles = 1'000'000;  // 20 ms: they all wait in the FIFO
  Bench bench(parameters);
  bench.send({0x7F}, ms(9));  // handed over in another order than that of their arrival
  bench.send({0x01}, ms(3));
  bench.send({0x02}, ms(7));
  bench.send({0x03, 0x01}, ms(5));
  bench.run(ms(40));
  std::vector<Bytes> answers;
  for (const nfc::Frame& frame : bench.answers) answers.push_back(data_of(frame).value());
  REQUIRE(answers.size() == 4);
  CHECK(answers[0].size() == 5);
  CHECK(answers[1] == Bytes{0x00});
  CHECK(answers[2].size() == 3);
  CHECK(answers[3] == Bytes{0x01});
}

TEST_CASE("a command that finds the FIFO full is lost and counted") {
  SensorParameters parameters = sensor::charged();
  parameters.control_unit.boot_cycles = 1'000'000;
  parameters.transceiver.fifo_depth = 2;
  Bench bench(parameters);
  for (int i = 0; i < 5; ++i) bench.send({0x01}, ms(3 + i));
  bench.run(ms(40));
  CHECK(bench.frames().received == 5);
  CHECK(bench.answers.size() == 2);
  CHECK(bench.read([](Sensor& s) { return s.fifo.overflows(); }) == 3);
}

TEST_CASE("it sleeps when it has nothing to do, and then nothing happens in the kernel") {
  Bench bench;
  bench.run(ms(5));
  CHECK(bench.powered());
  CHECK_FALSE(bench.awake());
  const auto next = bench.device.next_event();  // brown-out, far away
  CHECK((!next || *next > ms(10'000)));

  SensorParameters parameters = sensor::charged();
  parameters.control_unit.clock_gating = false;
  Bench running(parameters);
  running.run(ms(2));
  CHECK_FALSE(running.awake());
  CHECK(running.device.next_event().value() - ms(2) <= Duration(10'000));
}

TEST_CASE("gating the clock changes nothing that can be seen from outside") {
  const auto steps = [](Time now) { return now + Duration(1'000'000'000); };
  SensorParameters parameters = sensor::charged();
  parameters.control_unit.clock_frequency = 5e6;
  const StepRecord gated = run_in_steps(parameters, steps);
  parameters.control_unit.clock_gating = false;
  const StepRecord running = run_in_steps(parameters, steps);
  CHECK(gated.answers.size() >= 3);
  CHECK(gated == running);
}

TEST_CASE("any split of a run into steps gives the same bits") {
  const StepRecord whole = run_in_steps(sensor::charged(), [](Time) { return Time::max(); });
  REQUIRE(whole.answers.size() >= 3);
  const auto every = [](Duration size) { return [size](Time now) { return now + size; }; };
  CHECK(run_in_steps(sensor::charged(), every(Duration(1'000'000'000))) == whole);
  CHECK(run_in_steps(sensor::charged(), every(Duration(13'370'001))) == whole);

  std::mt19937 random(1);  // its sequence is part of the C++ standard
  CHECK(run_in_steps(sensor::charged(), [&](Time now) {
          return now + Duration(1 + random() % 3'000'000'000);
        }) == whole);
}

TEST_CASE("two sensors, run in turn, give the results that each gives alone") {
  const auto drive = [](Bench& bench, int i, double temperature) {
    bench.temperature(temperature);
    if (i % 5 == 0) bench.send({0x02}, ms(i + 0.25));
    bench.run(ms(i + 1));
  };
  Bench cold;
  Bench hot;
  for (int i = 0; i < 50; ++i) {
    drive(cold, i, -10);
    drive(hot, i, 80);
  }
  Bench alone;
  for (int i = 0; i < 50; ++i) drive(alone, i, 80);
  CHECK(hot.answers == alone.answers);
  REQUIRE(cold.answers.size() == hot.answers.size());
  CHECK(data_of(cold.answers.back()) != data_of(hot.answers.back()));
}

TEST_CASE("a sensor that lost its power has forgotten, and boots again") {
  Bench bench;
  bench.send({0x03, 0x01}, ms(5));
  bench.run(ms(10));
  CHECK(bench.led());
  bench.run(ms(3000));  // the LED empties the capacitor
  CHECK_FALSE(bench.powered());
  CHECK_FALSE(bench.led());
  bench.send({0x01}, ms(3000));
  bench.run(ms(3010));
  CHECK(bench.answers.size() == 1);

  bench.field(5e-3);
  bench.run(ms(3300));
  CHECK(bench.powered());
  CHECK_FALSE(bench.led());
  bench.send({0x01}, ms(3300));
  bench.run(ms(3310));
  CHECK(bench.answers.size() == 2);
}

TEST_CASE("a command that was waiting when power failed is forgotten") {
  SensorParameters parameters = sensor::charged();
  parameters.control_unit.boot_cycles = 1'000'000;  // 20 ms, more than the capacitor can bear
  parameters.power.capacitance = 1e-6;
  Bench bench(parameters);
  bench.send({0x01}, ms(0.1));
  bench.run(ms(5));
  CHECK(bench.frames().received == 1);
  CHECK_FALSE(bench.powered());
  bench.field(50e-3);
  bench.run(ms(100));
  CHECK(bench.powered());
  CHECK(bench.answers.empty());
  bench.send({0x01}, ms(100));
  bench.run(ms(105));
  CHECK(bench.answers.size() == 1);
}

TEST_CASE("sensors can be made and destroyed hundreds of times") {
  std::vector<nfc::Frame> first;
  SensorParameters parameters = sensor::charged();
  parameters.control_unit.boot_cycles = 1000;
  for (int i = 0; i < 200; ++i) {
    Bench bench(parameters);
    bench.send({0x02}, ms(2));
    bench.run(ms(4));
    if (i == 0) first = bench.answers;
    REQUIRE(bench.answers.size() == 1);
    REQUIRE(bench.answers == first);
  }
}

TEST_CASE("the signals to trace bear the paper's names") {
  Bench bench;
  std::vector<std::string> names;
  bench.device.within([&](Sensor& sensor) {
    visit_signals(sensor, [&](const auto& signal) { names.push_back(signal.basename()); });
  });
  for (const char* name :
       {"recData", "DataUCToTrm", "EnergyIntake", "EnergyLoad", "Charge", "Voltage"}) {
    CAPTURE(name);
    CHECK(std::count(names.begin(), names.end(), name) == 1);
  }
}

TEST_CASE("parameters out of range are named") {
  SensorParameters parameters;
  parameters.power.capacitance = -1;
  const auto make = [&] { Bench bench(parameters); };
  CHECK_THROWS_WITH(make(), Catch::Matchers::Contains("power.capacitance"));
}
