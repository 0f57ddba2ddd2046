// The sensor with and without idle skipping, and its promises.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/sensor/simulated_sensor.h"

using sensor::kCommands;
using sensor::kFields;
using sensor::kMillisecond;
using sensor::kSecond;
using sensor::outputs;
using sensor::prepare;
using sensor::Record;
using sensor::SensorSettings;
using sensor::simulate;
using sensor::UnitBench;
using stride::Duration;
using stride::Time;

namespace {

void check_same(const Record& record, const Record& expected) {
  CHECK(record.answers == expected.answers);
  CHECK(record.received_at == expected.received_at);
  CHECK(record.outputs == expected.outputs);
}

}  // namespace

TEST_CASE("skipping changes no frame, no instant and no bit of an output") {
  const double frequency = 1e6;
  std::size_t answers = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Record plain = simulate(SensorSettings{true, {}, "", frequency}, seed);
    answers += plain.answers.size();
    CAPTURE(seed);
    for (const bool gating : {true, false}) {
      CAPTURE(gating);
      check_same(simulate(SensorSettings{gating, Duration::max(), "", frequency}, seed), plain);
      if (seed > 10) continue;
      check_same(simulate(SensorSettings{gating, 3 * kMillisecond, "", frequency}, seed), plain);
    }
    if (seed <= 3) check_same(simulate(SensorSettings{false, {}, "", frequency}, seed), plain);
  }
  CHECK(answers > 1000);
}

namespace {

/// Steps a sensor on from where it is, and checks that it keeps the promise. Returns how many
/// outputs moved.
void check_promise(UnitBench& bench, Time until) {
  struct Output {
    const stride::Variable* row;
    double value, rate;
  };
  std::vector<Output> tangents;
  for (const stride::Variable& row : bench.unit().variables()) {
    if (row.type != stride::Type::Float64 || row.causality != stride::Causality::Output) continue;
    REQUIRE(row.tolerance.has_value());
    tangents.push_back({&row, *static_cast<const double*>(row.data), *row.derivative});
  }
  const auto discrete = [&] {
    return std::vector<std::int64_t>{
        bench.value<bool>("led"),
        bench.value<bool>("mcu.powered"),
        bench.value<bool>("mcu.awake"),
        bench.value<bool>("mcu.selected"),
        bench.value<std::int32_t>("adc.value"),
        bench.value<std::int32_t>("log.samples"),
        bench.value<std::int32_t>("frames.received"),
        bench.value<std::int32_t>("frames.rejected"),
        bench.value<std::int32_t>("frames.sent"),
        bench.value<std::int32_t>("frames.cut"),
        bench.value<std::int32_t>("frames.dropped"),
        bench.value<std::int32_t>("commands.lost"),
    };
  };
  const std::vector<std::int64_t> before = discrete();
  const std::size_t answers = bench.answers.size();
  const Time from = bench.now();
  for (int i = 1; i <= 7; ++i) {
    // the end is not part of the promise
    const Time to = i < 7 ? from + (until - from) / 7 * i : until - Duration(1);
    if (to <= bench.now()) continue;
    bench.step(to, true);
    REQUIRE(bench.now() == to);
    CHECK(discrete() == before);
    CHECK(bench.answers.size() == answers);
    const double elapsed = stride::to_seconds(to - from);
    for (const Output& output : tangents) {
      const double now = *static_cast<const double*>(output.row->data);
      INFO(output.row->name << " after " << elapsed << " s");
      CHECK(std::abs(now - (output.value + output.rate * elapsed)) <=
            *output.row->tolerance * (1 + 1e-9));
    }
  }
}

}  // namespace

TEST_CASE("while the sensor promises to be idle, its outputs keep their tangents") {
  std::mt19937 random(11);  // its sequence is part of the C++ standard
  int promises = 0;
  Duration longest{};
  for (int i = 0; i < 60; ++i) {
    UnitBench bench;
    bench.value<double>("power.initial_voltage") = 2.0 + random() % 31 * 0.1;
    bench.value<double>("power.leakage_resistance") = random() % 2 == 0 ? 10e6 : 20e3;
    bench.enable_skipping(4 * kSecond);
    bench.value<double>("field_power") = kFields[random() % 4];
    bench.initialize();
    for (int k = 0; k < 12; ++k) {
      bench.run(bench.now() + Duration(1 + static_cast<std::int64_t>(random()) * 8), true,
                20 * kMillisecond);
      const Time until = std::min(bench.idle_until(), bench.now() + 4 * kSecond);
      if (until > bench.now()) {
        ++promises;
        longest = std::max(longest, until - bench.now());
        check_promise(bench, until);
      }
      bench.value<double>("field_power") = kFields[random() % 4];
      if (random() % 2 == 0) bench.send(sensor::request(kCommands[random() % 9], bench.now()));
    }
  }
  CHECK(promises > 300);
  CHECK(longest == 4 * kSecond);
}

TEST_CASE("what one step over a promise gives is what many give") {
  UnitBench many;
  UnitBench one;
  for (UnitBench* bench : {&many, &one}) {
    prepare(*bench, SensorSettings{false, Duration::max(), ""});
    bench->run(bench->now() + 40 * kMillisecond, true);
    bench->send(sensor::request({0x06, 0x00, 0x02}, bench->now()));  // a sample every 2 s
    bench->run(bench->now() + 10 * kMillisecond, true);
  }
  const Time until = one.idle_until();
  CHECK(until > one.now() + kSecond);
  one.step(until, true);
  many.run(until, true, 13 * kMillisecond);
  CHECK(one.now() == until);
  CHECK(outputs(one) == outputs(many));
}

TEST_CASE("a promise ends where the timer goes off, and there is none while something happens") {
  UnitBench bench;
  prepare(bench, SensorSettings{true, Duration::max(), ""});
  CHECK(bench.idle_until() == bench.now());  // it boots
  bench.run(bench.now() + 40 * kMillisecond, true);
  CHECK(bench.idle_until() > bench.now() + kSecond);

  bench.send(sensor::request({0x06, 0x00, 0x01}, bench.now()));  // a sample every second
  CHECK(bench.idle_until() == bench.now());                      // the frame is being received
  bench.run(bench.now() + 10 * kMillisecond, true);
  REQUIRE(bench.answers.size() == 1);
  const Time until = bench.idle_until();
  CHECK(until < bench.answers[0].start + kSecond);
  CHECK(until > bench.answers[0].start + kSecond - kMillisecond);
  bench.step(until - Duration(1), true);
  CHECK_FALSE(bench.value<bool>("mcu.awake"));
  bench.step(until, true);
  CHECK(bench.value<bool>("mcu.awake"));
  CHECK(bench.idle_until() == bench.now());

  bench.run(until + 5 * kMillisecond, true);
  CHECK(bench.value<std::int32_t>("log.samples") == 1);
  bench.value<double>("field_power") = 5e-3;
  CHECK(bench.idle_until() == bench.now());  // an input that has not been taken up
}
