// The sensor as a unit: driven through the kit's interface, as the FMI layer does it.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/unit.h>

#include "tests/units/sensor/bench.h"

using stride::Binary;
using stride::Clock;
using stride::Duration;
using stride::Event;
using stride::Step;
using stride::Time;

namespace {

constexpr Duration kMillisecond{1'000'000'000};

class UnitBench {
 public:
  UnitBench() : unit_(stride::unit_factory().make({{}, "sensor"})) {}

  template <class T>
  T& value(const std::string& name) {
    for (const stride::Variable& row : unit_->variables()) {
      if (row.name == name) return *static_cast<T*>(row.data);
    }
    throw std::out_of_range("no variable " + name);
  }

  void initialize(Time start) {
    now_ = start;
    unit_->initialize(start);
  }

  /// One step, and the events at its end, each message of which is kept.
  void step(Time to, bool may_return_early) {
    Step step(now_, to, may_return_early);
    unit_->step(step);
    now_ = step.reached().value_or(to);
    take_message();
    while (clock().ticked()) handle_event();
  }

  void run(Time to, bool may_return_early, Duration size = kMillisecond) {
    while (now_ < to) step(std::min(to, now_ + size), may_return_early);
  }

  void send(const nfc::Frame& frame) {
    value<Binary>("receive.frame") = nfc::encode(frame);
    value<Clock>("receive.clock").tick();
    handle_event();
  }

  Time now() const { return now_; }

  std::vector<nfc::Frame> answers;
  std::vector<Time> received_at;

 private:
  Clock& clock() { return value<Clock>("transmit.clock"); }

  void handle_event() {
    clock().clear();
    Event event(now_);
    unit_->event(event);
    value<Clock>("receive.clock").clear();
    take_message();
  }

  void take_message() {
    if (!clock().ticked()) return;
    answers.push_back(nfc::decode(value<Binary>("transmit.frame")));
    received_at.push_back(now_);
  }

  std::unique_ptr<stride::Unit> unit_;
  Time now_;
};

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
  bench.value<double>("field_power") = 4e-3;
  bench.initialize(Time());
  CHECK(bench.value<double>("energy.intake") == Approx(2e-3));
}

TEST_CASE("a parameter out of range is an error at initialization") {
  UnitBench bench;
  bench.value<double>("adc.maximum") = -50;
  CHECK_THROWS_WITH(bench.initialize(Time()), Catch::Matchers::Contains("adc.maximum"));
}
