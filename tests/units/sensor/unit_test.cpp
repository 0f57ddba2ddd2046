// The sensor as a unit: driven through the kit's interface, as the FMI layer does it.
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/sensor/unit_bench.h"

using sensor::kMillisecond;
using sensor::UnitBench;
using stride::Duration;
using stride::Time;

namespace {

void charge_and_ask(UnitBench& bench, Time start, bool may_return_early) {
  bench.value<double>("power.initial_voltage") = 4.0;
  bench.value<double>("adc.temperature") = 31.0;
  bench.initialize(start);
  bench.run(start + 5 * kMillisecond, may_return_early);
  bench.send(sensor::request({0x02}, bench.now() + Duration(123'456)));
  bench.run(start + 8 * kMillisecond, may_return_early);
}

}  // namespace

TEST_CASE("an answer leaves at its own instant where early return is allowed") {
  UnitBench bench;
  charge_and_ask(bench, Time(), true);
  REQUIRE(bench.answers.size() == 1);
  CHECK(bench.received_at[0] == bench.answers[0].start);
  CHECK(bench.value<std::int32_t>("frames.received") == 1);
  CHECK(bench.value<std::int32_t>("frames.sent") == 1);
}

TEST_CASE("an answer leaves at the end of the step where early return is not allowed") {
  UnitBench early;
  charge_and_ask(early, Time(), true);
  UnitBench bench;
  charge_and_ask(bench, Time(), false);
  CHECK(bench.answers == early.answers);
  REQUIRE(bench.received_at.size() == 1);
  CHECK(bench.received_at[0] == Time(6 * kMillisecond));
}

TEST_CASE("messages of one step leave one by one") {
  UnitBench bench;
  bench.value<double>("power.initial_voltage") = 4.0;
  bench.initialize(Time());
  bench.run(Time(5 * kMillisecond), false);
  for (int i = 0; i < 3; ++i) {
    bench.send(sensor::request({0x01}, bench.now() + 3 * i * kMillisecond));
  }
  bench.run(Time(25 * kMillisecond), false, 20 * kMillisecond);
  REQUIRE(bench.answers.size() == 3);
  CHECK(bench.answers[0].start < bench.answers[1].start);
  CHECK(bench.answers[1].start < bench.answers[2].start);
  CHECK(bench.received_at == std::vector<Time>(3, Time(25 * kMillisecond)));
}

TEST_CASE("frames carry the master's time, whatever the start time is") {
  const Time start(1000 * kMillisecond + Duration(7));
  UnitBench from_zero;
  charge_and_ask(from_zero, Time(), true);
  UnitBench bench;
  charge_and_ask(bench, start, true);
  REQUIRE(bench.answers.size() == 1);
  CHECK(bench.answers[0].start == start + from_zero.answers[0].start.time_since_epoch());
  CHECK(bench.answers[0].bits == from_zero.answers[0].bits);
}

TEST_CASE("initialize starts from scratch each time") {
  UnitBench bench;
  charge_and_ask(bench, Time(), true);
  const std::vector<nfc::Frame> first = bench.answers;
  bench.answers.clear();
  charge_and_ask(bench, Time(), true);
  CHECK(bench.answers == first);
  CHECK(bench.value<std::int32_t>("frames.sent") == 1);

  bench.value<double>("power.initial_voltage") = 2.0;
  bench.initialize(Time());
  CHECK_FALSE(bench.value<bool>("mcu.powered"));
  CHECK(bench.value<double>("capacitor.voltage") == Approx(2.0));
  CHECK(bench.value<double>("capacitor.charge") == Approx(200e-6));
}

TEST_CASE("the inputs count from the start") {
  UnitBench bench;
  bench.value<double>("field_power") = sensor::field_for({}, 0.4e-3);
  bench.initialize(Time());
  CHECK(bench.value<double>("energy.intake") == Approx(2e-3));
  CHECK(bench.value<double>("supply.voltage") == 5.0);
  CHECK(bench.value<double>("capacitor.voltage") == Approx(0.4e-3 * 100));
}

TEST_CASE("a parameter out of range is an error at initialization") {
  UnitBench bench;
  bench.value<double>("adc.maximum") = -50;
  CHECK_THROWS_WITH(bench.initialize(Time()), Catch::Matchers::Contains("adc.maximum"));
}

TEST_CASE("an answer that a step's inputs cut off is handed over where the step begins") {
  for (const bool may_return_early : {true, false}) {
    UnitBench bench;
    bench.value<double>("power.initial_voltage") = 4.0;
    bench.initialize(Time());
    bench.run(Time(5 * kMillisecond), may_return_early);
    bench.send(sensor::request({0x01}, bench.now()));
    const Time cut(Duration(5'600'000'000));
    bench.run(cut, may_return_early, kMillisecond / 10);
    REQUIRE(bench.answers.size() == 1);
    bench.value<double>("field_power") = 0;
    bench.step(Time(6 * kMillisecond), may_return_early);
    REQUIRE(bench.answers.size() == 2);
    CHECK(bench.answers[1] == nfc::cut_off(bench.answers[0], cut));
    CHECK(bench.answers[1].bits.size() < bench.answers[0].bits.size());
    CHECK(bench.received_at[1] == (may_return_early ? cut : Time(6 * kMillisecond)));
    CHECK(bench.now() == bench.received_at[1]);
    CHECK(bench.value<std::int32_t>("frames.cut") == 1);
    bench.run(Time(8 * kMillisecond), may_return_early);
    CHECK(bench.now() == Time(8 * kMillisecond));
  }
}

TEST_CASE("two instances, stepped in turn, give the results that each gives alone") {
  struct Side {
    double temperature;
    std::int32_t identifier;
    Duration step;
  };
  const Side sides[] = {{-10, 0x11111111, kMillisecond}, {70, 0x22222222, kMillisecond / 3}};
  const auto start = [](UnitBench& bench, const Side& side) {
    bench.value<double>("power.initial_voltage") = 4.0;
    bench.value<double>("adc.temperature") = side.temperature;
    bench.value<std::int32_t>("control_unit.identifier") = side.identifier;
    bench.value<bool>("transceiver.always_selected") = false;
    bench.initialize(Time());
  };
  // both hear all, as on one channel: identify, select the second, read its temperature
  const auto drive = [](UnitBench& bench, const Side& side, int i) {
    if (i == 5) bench.send(sensor::request({0x01}, bench.now()));
    if (i == 10) bench.send(sensor::request({0x04, 0x22, 0x22, 0x22, 0x22}, bench.now()));
    if (i == 15) bench.send(sensor::request({0x02}, bench.now()));
    bench.value<double>("field_power") = i % 7 < 3 ? 2e-3 : 1e-3;
    bench.run(bench.now() + kMillisecond, true, side.step);
  };
  std::vector<nfc::Frame> alone[2];
  for (int k = 0; k < 2; ++k) {
    UnitBench bench;
    start(bench, sides[k]);
    for (int i = 0; i < 20; ++i) drive(bench, sides[k], i);
    alone[k] = bench.answers;
  }
  UnitBench together[2];
  for (int k = 0; k < 2; ++k) start(together[k], sides[k]);
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 2; ++k) drive(together[k], sides[k], i);
  }
  CHECK(together[0].answers == alone[0]);
  CHECK(together[1].answers == alone[1]);
  REQUIRE(alone[0].size() == 1);
  REQUIRE(alone[1].size() == 3);
  CHECK(sensor::data_of(alone[0][0]) == nfc::Bytes{0x00, 0x11, 0x11, 0x11, 0x11});
  CHECK(sensor::data_of(alone[1][1]) == nfc::Bytes{0x00});
  CHECK(sensor::data_of(alone[1][2])->size() == 3);
  CHECK(together[1].value<bool>("mcu.selected"));
  CHECK_FALSE(together[0].value<bool>("mcu.selected"));
}

TEST_CASE("the energy balance is among the outputs") {
  UnitBench bench;
  bench.value<double>("power.initial_voltage") = 4.0;
  bench.value<double>("field_power") = 6e-3;
  bench.initialize(Time());
  bench.run(Time(5 * kMillisecond), true);
  bench.send(sensor::request({0x03, 0x01}, bench.now()));
  bench.run(Time(200 * kMillisecond), true);
  const double spent =
      bench.sum_of({"balance.stored", "balance.rectifier", "balance.limiter", "balance.charger",
                    "balance.series_resistance", "balance.leakage", "balance.regulator",
                    "balance.control_unit", "balance.transceiver", "balance.adc", "balance.led"});
  CHECK(bench.value<double>("balance.led") == Approx(1e-3 * 1.8 * 0.1944).epsilon(1e-2));
  CHECK(bench.value<double>("balance.field") == Approx(spent).epsilon(1e-13));
}
