// The firmware: what the sensor says to each command.
#include "units/sensor/control_unit.h"

#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/sensor/bench.h"

using nfc::Bytes;
using sensor::Bench;
using sensor::data_of;
using sensor::ms;
using sensor::Sensor;
using sensor::SensorParameters;

namespace {

const Bytes kIdentify = {0x01};
const Bytes kReadTemperature = {0x02};
const Bytes kReadLog = {0x05};
const Bytes kSleep = {0x07};
const Bytes kOk = {0x00};
const Bytes kUnknown = {0x01};
const Bytes kBadArgument = {0x02};
const Bytes kIdentity = {0x00, 0x53, 0x45, 0x4E, 0x53};
const Bytes kSelect = {0x04, 0x53, 0x45, 0x4E, 0x53};
const Bytes kSelectOther = {0x04, 0x53, 0x45, 0x4E, 0x54};

Bytes set_led(std::uint8_t on) { return {0x03, on}; }
Bytes set_sampling_period(int seconds) {
  return {0x06, static_cast<std::uint8_t>(seconds >> 8), static_cast<std::uint8_t>(seconds)};
}

/// Asks at 5 ms, 10 ms, …; nothing is what silence is.
class Dialogue {
 public:
  explicit Dialogue(const SensorParameters& parameters = sensor::charged()) : bench(parameters) {}

  std::optional<Bytes> operator()(const Bytes& command) {
    return at((bench.device.now() + ms(5).time_since_epoch()), command);
  }
  std::optional<Bytes> at(stride::Time time, const Bytes& command) {
    const std::size_t before = bench.answers.size();
    bench.ask(command, time);
    bench.run(bench.device.now() + ms(4).time_since_epoch());  // the longest answer takes 3 ms
    REQUIRE(bench.answers.size() <= before + 1);
    if (bench.answers.size() == before) return std::nullopt;
    return data_of(bench.answers.back()).value();
  }

  Bench bench;
};

SensorParameters one_of_many() {
  SensorParameters parameters = sensor::charged();
  parameters.transceiver.always_selected = false;
  return parameters;
}

/// With energy for a minute.
SensorParameters enduring() {
  SensorParameters parameters = sensor::charged();
  parameters.power.capacitance = 0.1;
  return parameters;
}

int age(const Bytes& answer, std::size_t sample) {
  return answer.at(1 + 4 * sample) << 8 | answer.at(2 + 4 * sample);
}
double temperature(const Bytes& answer, std::size_t sample) {
  return static_cast<std::int16_t>(answer.at(3 + 4 * sample) << 8 | answer.at(4 + 4 * sample)) /
         100.0;
}
std::size_t samples(const Bytes& answer) {
  REQUIRE((answer.size() - 1) % 4 == 0);
  return (answer.size() - 1) / 4;
}

}  // namespace

TEST_CASE("each command has its answer") {
  Dialogue ask;
  CHECK(ask(kIdentify) == kIdentity);
  CHECK(ask(kReadTemperature) == Bytes{0x00, 0x07, 0xD0});  // 20.00 degC is the nearest code
  CHECK(ask(set_led(1)) == kOk);
  CHECK(ask(kSelect) == kOk);
  CHECK(ask(kReadLog) == kOk);
  CHECK(ask(set_sampling_period(60)) == kOk);
  CHECK(ask(kSleep) == kOk);
}

TEST_CASE("what is not a command, or has wrong arguments, is answered by the protocol's error") {
  Dialogue ask;
  CHECK(ask({0x7F}) == kUnknown);
  CHECK(ask({0x00}) == kUnknown);
  CHECK(ask({}) == kUnknown);
  CHECK(ask({0x01, 0x00}) == kBadArgument);
  CHECK(ask({0x03}) == kBadArgument);
  CHECK(ask(set_led(2)) == kBadArgument);
  CHECK(ask({0x03, 0x01, 0x01}) == kBadArgument);
  CHECK(ask({0x04, 0x53, 0x45, 0x4E}) == kBadArgument);
  CHECK(ask({0x06, 0x01}) == kBadArgument);
  CHECK_FALSE(ask.bench.led());
}

TEST_CASE("a sensor that is not selected identifies itself and is silent otherwise") {
  Dialogue ask(one_of_many());
  CHECK(ask(kIdentify) == kIdentity);
  CHECK_FALSE(ask(kReadTemperature).has_value());
  CHECK_FALSE(ask(set_led(1)).has_value());
  CHECK_FALSE(ask({0x7F}).has_value());
  CHECK_FALSE(ask({0x01, 0x00}).has_value());
  CHECK_FALSE(ask(kSelectOther).has_value());
  CHECK_FALSE(ask({0x04, 0x53}).has_value());
  CHECK_FALSE(ask.bench.led());
  CHECK(ask.bench.frames().received == 7);
}

TEST_CASE("a selected sensor answers until another one is selected, or it sleeps") {
  Dialogue ask(one_of_many());
  CHECK(ask(kSelect) == kOk);
  CHECK(ask(set_led(1)) == kOk);
  CHECK(ask({0x7F}) == kUnknown);
  CHECK_FALSE(ask(kSelectOther).has_value());
  CHECK_FALSE(ask(set_led(0)).has_value());
  CHECK(ask.bench.led());

  CHECK(ask(kSelect) == kOk);
  CHECK(ask(kSleep) == kOk);
  CHECK_FALSE(ask.bench.led());
  CHECK_FALSE(ask.bench.awake());
  CHECK_FALSE(ask(kReadTemperature).has_value());
  CHECK(ask(kIdentify) == kIdentity);
}

TEST_CASE("the loss of the field deselects") {
  Dialogue ask(one_of_many());
  CHECK(ask(kSelect) == kOk);
  ask.bench.field(0);
  ask.bench.run(ask.bench.device.now() + ms(1).time_since_epoch());
  ask.bench.field(sensor::kCarrier);
  CHECK_FALSE(ask(kReadTemperature).has_value());
  CHECK(ask(kSelect) == kOk);
  CHECK(ask(kReadTemperature).has_value());
}

TEST_CASE("a sensor that is always selected is silent to the selection of another one only") {
  Dialogue ask;
  CHECK_FALSE(ask(kSelectOther).has_value());
  CHECK(ask(kReadTemperature).has_value());
  CHECK(ask(kSleep) == kOk);
  CHECK(ask(kReadTemperature).has_value());
}

TEST_CASE("the timer wakes it, it samples, logs and sleeps again") {
  Dialogue ask(enduring());
  ask.bench.temperature(10);
  REQUIRE(ask.at(ms(5), set_sampling_period(2)) == kOk);
  const stride::Time set = ask.bench.answers.back().start;
  ask.bench.run(set + ms(1990).time_since_epoch());
  CHECK_FALSE(ask.bench.awake());
  CHECK(ask.bench.read([](Sensor& s) { return s.control_unit.log().size(); }) == 0);

  ask.bench.temperature(30);
  ask.bench.run(set + ms(2000).time_since_epoch() + ms(1).time_since_epoch());
  CHECK(ask.bench.read([](Sensor& s) { return s.control_unit.log().size(); }) == 1);
  CHECK_FALSE(ask.bench.awake());
  const auto next = ask.bench.device.next_event();
  REQUIRE(next.has_value());  // in between nothing happens in the kernel
  CHECK(stride::to_seconds(*next - set) == Approx(4.0).margin(1e-4));
}

TEST_CASE("the log is read oldest first, with the samples' ages") {
  Dialogue ask(enduring());
  REQUIRE(ask.at(ms(5), set_sampling_period(1)) == kOk);
  for (int second = 0; second < 4; ++second) {
    ask.bench.temperature(10 + 5 * second);
    ask.bench.run(ms(1000.0 * second + 1500));
  }
  const Bytes answer = ask(kReadLog).value();  // at 4.505 s, samples at 1.005 s ...
  REQUIRE(samples(answer) == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(age(answer, i) == 3 - static_cast<int>(i));
    CHECK(temperature(answer, i) == Approx(10 + 5.0 * static_cast<double>(i)).margin(0.03));
  }
  CHECK(ask(kReadLog) == answer);
}

TEST_CASE("only the last samples are kept, and an age that is too large for its field is marked") {
  SensorParameters parameters = enduring();
  parameters.power.capacitance = 10;
  Dialogue ask(parameters);
  REQUIRE(ask(set_sampling_period(1)) == kOk);
  ask.bench.run(ms(12'300));
  REQUIRE(ask(set_sampling_period(0)) == kOk);
  const Bytes answer = ask(kReadLog).value();
  REQUIRE(samples(answer) == 8);
  CHECK(age(answer, 0) == 7);
  CHECK(age(answer, 7) == 0);

  ask.bench.run(ms(70'000'000));
  const Bytes later = ask(kReadLog).value();
  CHECK(samples(later) == 8);
  CHECK(age(later, 7) == 65535);
}

TEST_CASE("a period of zero, a new period and a brown-out stop the timer") {
  Dialogue ask(enduring());
  const auto logged = [&] {
    return ask.bench.read([](Sensor& s) { return s.control_unit.log().size(); });
  };
  ask.at(ms(5), set_sampling_period(1));
  ask.at(ms(500), set_sampling_period(3));
  ask.bench.run(ms(3400));
  CHECK(logged() == 0);
  ask.bench.run(ms(3600));
  CHECK(logged() == 1);
  ask.at(ms(3700), set_sampling_period(0));
  ask.bench.run(ms(9000));
  CHECK(logged() == 1);

  SensorParameters parameters = sensor::charged();
  Dialogue short_lived(parameters);
  short_lived.at(ms(5), set_sampling_period(1));
  short_lived.bench.run(ms(1100));
  CHECK(short_lived.bench.read([](Sensor& s) { return s.control_unit.log().size(); }) == 1);
  REQUIRE(short_lived(set_led(1)) == kOk);
  short_lived.bench.run(ms(2000));
  CHECK_FALSE(short_lived.bench.powered());
  short_lived.bench.field(20e-3);
  short_lived.bench.run(ms(5000));
  CHECK(short_lived.bench.powered());
  CHECK(short_lived(kReadLog) == kOk);
}

TEST_CASE("a command that comes while a sample is taken is answered after it") {
  Dialogue ask(enduring());
  ask.at(ms(5), set_sampling_period(1));
  stride::Time wakes;
  for (wakes = ms(1000); !ask.bench.awake(); wakes += stride::Duration(1'000'000)) {
    ask.bench.run(wakes);  // to a microsecond
  }
  const nfc::Frame frame = sensor::request(kReadTemperature, wakes);
  ask.bench.arrive(sensor::request(kReadTemperature, wakes - nfc::air_time(frame)));
  ask.bench.run(wakes + ms(3).time_since_epoch());
  CHECK(ask.bench.answers.size() == 2);
  CHECK(ask.bench.read([](Sensor& s) { return s.control_unit.log().size(); }) == 1);
}

TEST_CASE("the timer draws its current while there is a period") {
  Dialogue ask(enduring());
  const auto load = [&] {
    return ask.bench.read(
        [](Sensor& s) { return s.power_unit.load_now() / s.power_unit.rail_voltage_now(); });
  };
  ask.bench.run(ms(5));
  CHECK(load() == Approx(2.0e-6));
  ask(set_sampling_period(9));
  CHECK(load() == Approx(2.3e-6));
  ask(set_sampling_period(0));
  CHECK(load() == Approx(2.0e-6));
}
