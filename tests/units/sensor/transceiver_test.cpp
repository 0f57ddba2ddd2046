#include "units/sensor/transceiver.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/units/sensor/bench.h"

using nfc::Bytes;
using sensor::Bench;
using sensor::data_of;
using sensor::ms;
using sensor::PowerParameters;
using sensor::request;
using sensor::Sensor;
using sensor::SensorParameters;
using sensor::Supply;
using stride::Duration;
using stride::Time;

namespace {

const Bytes kIdentifyBytes = {0x01};
const Bytes kIdentityBytes = {0x00, 0x53, 0x45, 0x4E, 0x53};

}  // namespace

TEST_CASE("any single bit error in a request is found, and the request is not answered") {
  const std::size_t length = request(kIdentifyBytes, Time()).bits.size();
  REQUIRE(length == 27);
  Bench bench;
  for (std::size_t bit = 0; bit < length; ++bit) {
    nfc::Frame frame = request(kIdentifyBytes, ms(5 + 2.0 * static_cast<double>(bit)));
    frame.bits[bit] ^= 1;
    bench.arrive(frame);
  }
  bench.run(ms(100));
  CHECK(bench.frames().rejected == 27);
  CHECK(bench.frames().received == 0);
  CHECK(bench.answers.empty());

  bench.send(kIdentifyBytes, ms(100));
  bench.run(ms(105));
  CHECK(bench.frames().received == 1);
  CHECK(bench.answers.size() == 1);
}

TEST_CASE("a wrong CRC with right parities is found") {
  Bench bench;
  nfc::Frame frame;
  frame.start = ms(5);
  frame.bits = nfc::to_bits({0x01, 0x12, 0x34});
  bench.arrive(frame);
  bench.run(ms(10));
  CHECK(bench.frames().rejected == 1);
  CHECK(bench.answers.empty());
}

TEST_CASE("only 106 kbit/s is understood") {
  Bench bench;
  nfc::Frame frame = request(kIdentifyBytes, ms(5));
  frame.bit_rate = 212;
  bench.arrive(frame);
  bench.run(ms(10));
  CHECK(bench.frames().rejected == 1);
}

TEST_CASE("a request is received at the end of its air time, to the picosecond") {
  Bench bench;
  const nfc::Frame frame = request(kIdentifyBytes, ms(5) + Duration(123'457));
  bench.arrive(frame);
  const Time end = frame.start + nfc::air_time(frame);
  bench.run(end - Duration(1));
  CHECK(bench.frames().received == 0);
  bench.run(end);
  CHECK(bench.frames().received == 1);
  CHECK(bench.read([](Sensor& s) { return s.received_data.read(); }) == 0x01);
}

TEST_CASE("answers start on the grid of the frame delay time") {
  Bench bench;
  std::vector<Time> ends;
  for (int i = 0; i < 20; ++i) {
    const nfc::Frame frame = request(kIdentifyBytes, ms(5 + 3 * i) + Duration(1'234'567 * i));
    ends.push_back(frame.start + nfc::air_time(frame));
    bench.arrive(frame);
  }
  bench.run(ms(80));
  REQUIRE(bench.answers.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    // 1204 carrier periods after the end of communication begins, which lasts 128
    const double periods = stride::to_seconds(bench.answers[i].start - ends[i]) * 13.56e6;
    const double n = (periods + 128 - 1204) / 128;
    CHECK(std::round(n) >= 0);
    CHECK(std::abs(n - std::round(n)) < 1e-6);
    CHECK(data_of(bench.answers[i]) == kIdentityBytes);
  }
}

TEST_CASE("a frame whose start is past is received as if it had been handed over in time") {
  const nfc::Frame frame = request(kIdentifyBytes, ms(5));
  Bench in_time;
  in_time.arrive(frame);
  in_time.run(ms(10));
  Bench late;
  late.run(ms(5.1));
  late.arrive(frame);
  late.run(ms(10));
  REQUIRE(in_time.answers.size() == 1);
  CHECK(late.answers == in_time.answers);

  Bench too_late;  // its end is past too: it is complete at once
  too_late.run(ms(7));
  too_late.arrive(frame);
  too_late.run(ms(7));
  CHECK(too_late.frames().received == 1);
}

TEST_CASE("without power nothing is received, counted or answered") {
  Bench bench{SensorParameters()};
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(10));
  CHECK(bench.answers.empty());
  CHECK(bench.frames().received == 0);
  CHECK(bench.frames().rejected == 0);
}

TEST_CASE("a frame whose start was missed is not received") {
  SensorParameters parameters;
  parameters.power.initial_voltage = 2.999;
  parameters.power.start_up_delay = 0.1e-3;
  Bench bench(parameters);
  bench.field(5e-3);
  bench.send(kIdentifyBytes, ms(0.0));  // takes 0.27 ms
  bench.run(ms(0.05));
  CHECK_FALSE(bench.powered());
  bench.run(ms(0.2));
  CHECK(bench.powered());
  bench.run(ms(5));
  CHECK(bench.frames().received == 0);
  CHECK(bench.frames().rejected == 0);
}

TEST_CASE("frames that overlap garble each other") {
  Bench bench;
  bench.send(kIdentifyBytes, ms(5));
  bench.send(kIdentifyBytes, ms(5.1));
  bench.send(kIdentifyBytes, ms(8));
  bench.run(ms(12));
  CHECK(bench.frames().rejected == 2);
  CHECK(bench.frames().received == 1);
  CHECK(bench.answers.size() == 1);
}

TEST_CASE("frames that are handed over at their ends and overlap: the later one is garbled") {
  Bench bench;
  const nfc::Frame first = request(kIdentifyBytes, ms(5));
  const nfc::Frame second = request(kIdentifyBytes, ms(5.1));
  for (const nfc::Frame& frame : {first, second}) {
    bench.run(frame.start + nfc::air_time(frame));
    bench.arrive(frame);
  }
  bench.run(ms(10));
  CHECK(bench.frames().received == 1);
  CHECK(bench.frames().rejected == 1);
}

TEST_CASE("a frame may be handed over at any instant of its time on the air") {
  const nfc::Frame frame = request(kIdentifyBytes, ms(5) + Duration(4711));
  const Duration length = nfc::air_time(frame);
  std::vector<nfc::Frame> expected;
  for (const Duration after : {-length, Duration(0), length / 3, length}) {
    Bench bench;
    bench.run(frame.start + after);
    bench.arrive(frame);
    bench.run(ms(10));
    REQUIRE(bench.answers.size() == 1);
    if (expected.empty()) expected = bench.answers;
    CHECK(bench.answers == expected);
  }
}

TEST_CASE("a frame that was cut off is handed over short, and found so") {
  const nfc::Frame whole = request(kIdentifyBytes, ms(5));
  for (std::size_t bits = 1; bits < whole.bits.size(); ++bits) {
    Bench bench;
    nfc::Frame heard = whole;
    heard.bits.resize(bits);
    bench.run(ms(5) + nfc::bit_duration(106) * static_cast<std::int64_t>(bits + 1));
    bench.arrive(heard);
    bench.run(ms(10));
    CHECK(bench.frames().received == 0);
    CHECK(bench.frames().rejected == 1);
    CHECK(bench.answers.empty());
  }
}

TEST_CASE("a frame that is cut off while it is received takes its own place") {
  Bench bench;
  nfc::Frame frame = request(kIdentifyBytes, ms(5));
  bench.arrive(frame);
  bench.run(ms(5.1));
  frame.bits.resize(9);
  bench.arrive(frame);
  bench.run(ms(10));
  CHECK(bench.frames().received == 0);
  CHECK(bench.frames().rejected == 1);
}

TEST_CASE("a frame for the end of which there was no power is not received") {
  SensorParameters parameters = sensor::charged();
  parameters.power.initial_voltage = 3.0;
  parameters.control_unit.led_current = 0.1;  // the capacitor is empty in 1 ms
  Bench bench(parameters);
  bench.send({0x03, 0x01}, ms(5));
  bench.run(ms(7));
  REQUIRE_FALSE(bench.powered());
  bench.field(0.2);
  bench.run(ms(30));
  REQUIRE(bench.powered());
  const int received = bench.frames().received;
  const nfc::Frame frame = request(kIdentifyBytes, ms(6));
  bench.arrive(frame);  // the power came back meanwhile, but that does not help
  bench.run(ms(40));
  CHECK(bench.frames().received == received);
  CHECK(bench.frames().rejected == 0);
}

TEST_CASE("a frame that comes during an answer is rejected") {
  Bench bench;
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(8));
  REQUIRE(bench.answers.size() == 1);
  Bench again;
  again.send(kIdentifyBytes, ms(5));
  again.send(kIdentifyBytes, bench.answers[0].start + Duration(1));
  again.run(ms(8));
  CHECK(again.answers == bench.answers);
  CHECK(again.frames().rejected == 1);
}

TEST_CASE("power that fails during an answer cuts it off, and the rest is handed over") {
  SensorParameters parameters = sensor::charged();
  parameters.transceiver.transmit_current = 5e-3;  // the capacitor bears it for 0.3 ms
  parameters.power.initial_voltage = 3.0;
  parameters.power.capacitance = 3e-6;
  parameters.power.start_up_delay = 1;
  parameters.control_unit.boot_cycles = 100;
  Bench bench(parameters);
  bench.send(kIdentifyBytes, ms(0.1));
  bench.run(ms(20));
  CHECK(bench.frames().sent == 1);
  CHECK(bench.frames().cut == 1);
  CHECK_FALSE(bench.powered());
  REQUIRE(bench.answers.size() == 2);
  const nfc::Frame& whole = bench.answers[0];
  const nfc::Frame& rest = bench.answers[1];
  CHECK(rest.start == whole.start);
  CHECK(rest.bits.size() > 5);
  CHECK(rest.bits.size() < whole.bits.size());
  CHECK(std::equal(rest.bits.begin(), rest.bits.end(), whole.bits.begin()));
  CHECK_FALSE(data_of(rest).has_value());
}

TEST_CASE("a field that is switched off during an answer cuts it off there") {
  Bench bench;
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(5.4));
  REQUIRE(bench.answers.size() == 1);
  const nfc::Frame whole = bench.answers[0];
  const Time cut = whole.start + nfc::bit_duration(106) * 21;
  bench.run(cut);
  bench.field(0);
  bench.run(cut);
  REQUIRE(bench.answers.size() == 2);
  CHECK(bench.answers[1].start == whole.start);
  CHECK(bench.answers[1].bits == nfc::Bits(whole.bits.begin(), whole.bits.begin() + 20));
  CHECK(bench.frames().cut == 1);
  CHECK(bench.powered());

  bench.field(sensor::kCarrier);  // the device lives on its capacitor, and answers again
  bench.send(kIdentifyBytes, ms(10));
  bench.run(ms(15));
  REQUIRE(bench.answers.size() == 3);
  CHECK(data_of(bench.answers[2]) == kIdentityBytes);
}

TEST_CASE("an answer whose bits are all out is not cut off any more") {
  Bench bench;
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(5.6));
  REQUIRE(bench.answers.size() == 1);
  const nfc::Frame& whole = bench.answers[0];
  bench.run(whole.start + nfc::air_time(whole) - nfc::bit_duration(106));
  bench.field(0);
  bench.run(ms(10));
  CHECK(bench.answers.size() == 1);
  CHECK(bench.frames().cut == 0);
}

TEST_CASE("with a carrier of its own it answers without a field") {
  SensorParameters parameters = sensor::charged();
  parameters.transceiver.carrier_voltage = 0;
  Bench bench(parameters);
  bench.field(0);
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(10));
  REQUIRE(bench.answers.size() == 1);
  CHECK(data_of(bench.answers[0]) == kIdentityBytes);
  CHECK(bench.frames().dropped == 0);
}

TEST_CASE("without a carrier an answer is not started") {
  Bench bench;
  bench.send(kIdentifyBytes, ms(5));
  bench.run(ms(5.3));
  CHECK(bench.frames().received == 1);
  const double least = Supply(PowerParameters()).field_power_for(3.0);
  bench.field(0.99 * least);
  bench.run(ms(10));
  CHECK(bench.answers.empty());
  CHECK(bench.frames().sent == 0);
  CHECK(bench.frames().dropped == 1);
  bench.field(least);
  bench.send(kIdentifyBytes, ms(10));
  bench.run(ms(15));
  CHECK(bench.answers.size() == 1);
}
