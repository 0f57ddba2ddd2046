#include "units/nfc_channel/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

#include "units/channel/decibels.h"

using namespace nfc_channel;
using channel::decibels;
using stride::Duration;
using stride::Time;

namespace {

const Time kStart = stride::time_from_seconds(14.2);
const Duration kBit = nfc::bit_duration(106);

Pose facing(double distance) { return {{0.0, 0.0, distance}, {0.0, 0.0, -1.0}}; }

void approach(Channel& channel, double distance, double power = 0.5) {
  channel.move(Pose{}, std::vector<Pose>(channel.tag_count(), facing(distance)), power);
}

void approach_at(Channel& channel, Time now, double distance, double power = 0.5) {
  approach(channel, distance, power);
  channel.observe(now);
}

nfc::Frame request(Time start = kStart) {
  return {start, 106, nfc::to_bits(nfc::with_crc({0x02}))};
}

nfc::Frame zeros(std::size_t length) { return {kStart, 106, nfc::Bits(length, 0)}; }

using Heard = std::optional<nfc::Frame>;

/// Sends a frame at its start while nothing moves, and waits for its end.
Heard pass_down(Channel& channel, const nfc::Frame& frame) {
  channel.observe(frame.start);
  channel.from_reader(frame);
  channel.observe(frame.start + nfc::air_time(frame));
  return channel.to_tag(0);
}

Heard pass_up(Channel& channel, const nfc::Frame& frame) {
  channel.observe(frame.start);
  channel.from_tag(0, frame);
  channel.observe(frame.start + nfc::air_time(frame));
  return channel.to_reader();
}

std::size_t ones(const Heard& frame) {
  std::size_t count = 0;
  for (const auto bit : frame.value().bits) count += bit;
  return count;
}

std::string refusal(const Parameters& parameters) {
  try {
    Channel channel(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// Tags whose demodulator needs no voltage, so that noise alone decides what they hear.
Parameters sensitive(std::size_t tags = 1) {
  Parameters parameters;
  parameters.tags.resize(tags);
  for (TagParameters& tag : parameters.tags) tag.demodulator_voltage = tag.rectifier_drop = 0.0;
  return parameters;
}

Parameters two_tags() {
  Parameters parameters;
  parameters.tags.resize(2);
  parameters.tags[0].name.name = "door";
  parameters.tags[1].name.name = "window";
  return parameters;
}

}  // namespace

TEST_CASE(
    "The default tag works in the fields of its class, 6, and hears none that are 25 dB weaker") {
  // its antenna is within 25 mm x 20 mm: ISO/IEC 14443-1; 4.5 to 18 A/m: 14443-2, 6.3
  Channel channel;
  const auto reach = [&](double field) {
    double distance = 0.0;
    do {
      approach(channel, distance += 1e-4);
    } while (channel.link().field_strength > field);
  };
  reach(4.5);
  CHECK(channel.link().tag_power > 10e-3);
  CHECK(channel.link().bit_error_rate_down < 1e-12);
  CHECK(channel.link().bit_error_rate_up < 1e-12);
  CHECK(pass_down(channel, request()).has_value());
  channel.state() = Channel().state();
  reach(0.1 * 4.5);
  CHECK(pass_down(channel, request()).has_value());
  channel.state() = Channel().state();
  reach(0.06 * 4.5);
  CHECK_FALSE(pass_down(channel, request()).has_value());
}

TEST_CASE("The README's figures are those of the default tag") {
  Channel channel;
  const auto field_with = [&](double voltage) {
    double distance = 0.01;
    do {
      approach(channel, distance += 1e-5);
    } while (channel.link().tag_voltage > voltage);
    return channel.link().field_strength;
  };
  CHECK(field_with(53.0) == Approx(4.5).epsilon(0.01));
  CHECK(field_with(3.6) == Approx(0.28).epsilon(0.01));  // 3 V behind a rectifier that takes 0.6 V
  CHECK(field_with(5.6) == Approx(0.44).epsilon(0.01));  // 5 V

  const Parameters p;
  const Circuit circuit(ReaderAntenna(p.reader.coil, 0.0), p.tags[0].coil, p.tags[0].chip);
  const auto in_chip = [&](double distance) {
    const double mutual =
        mutual_inductance(p.reader.coil, Pose{}, p.tags[0].coil, facing(distance));
    return circuit.in_chip(circuit.operate(mutual, 0.5));
  };
  CHECK(in_chip(0.0292) == Approx(7.5e-3).epsilon(0.01));  // 4.5 A/m
  CHECK(in_chip(0.02) == Approx(12e-3).epsilon(0.03));
}

TEST_CASE("The antenna's voltage is that of its flux, raised by its quality") {
  // U0 = omega mu0 N A H Q: Finkenzeller, sect. 4.1.7
  Channel channel;
  approach(channel, 0.1);
  const Coil coil = Parameters().tags[0].coil;
  const double induced = kCarrierAngularFrequency * kVacuumPermeability * coil.turns * M_PI *
                         coil.radius * coil.radius * channel.link().field_strength * std::sqrt(2.0);
  CHECK(channel.link().tag_voltage == Approx(induced * 35.0).epsilon(2e-3));
}

TEST_CASE("The default tag is full of power near by, talks at 6 cm and is deaf at 20 cm") {
  Channel channel;
  approach(channel, 0.025);
  CHECK(channel.link().distance == Approx(0.025));
  CHECK(channel.link().tag_power > 5e-3);
  CHECK(channel.link().field_strength > 1.5);  // ISO/IEC 14443-2, 6.3: 1.5 to 7.5 A/m
  CHECK(channel.link().field_strength < 7.5);
  approach(channel, 0.06);
  CHECK(channel.link().tag_power < 2e-3);
  CHECK(channel.link().bit_error_rate_up < 1e-9);
  approach(channel, 0.2);
  CHECK(channel.link().tag_voltage < 0.6);  // which is the rectifier's drop
  CHECK(channel.link().tag_power > 0.0);
}

TEST_CASE("Field strength is that of a circular current, its mean over a small coil") {
  // H = N I a^2 / (2 (a^2 + d^2)^(3/2)): Finkenzeller, sect. 4.1.1.1
  Parameters p;
  p.tags[0].coil.radius = 1e-3;
  p.tags[0].coil.wire_radius = 1e-5;
  Channel channel(p);
  approach(channel, 0.05);
  const ReaderAntenna reader(p.reader.coil, 0.0);
  const double current = std::sqrt(2.0 * 0.5 / reader.resistance);
  const double a = 0.030;
  const double field = 4.0 * current * a * a / (2.0 * std::pow(a * a + 0.05 * 0.05, 1.5));
  CHECK(channel.link().field_strength == Approx(field / std::sqrt(2.0)).epsilon(1e-3));
}

TEST_CASE("Where the reader's field reaches, a small tag on its axis sees 1.5 A/m") {
  Parameters p;
  p.tags[0].coil.radius = 1e-3;
  p.tags[0].coil.wire_radius = 1e-5;
  Channel channel(p);
  approach(channel, 0.05);
  const double reach = channel.link().field_reach;
  CHECK(reach > 0.05);
  approach(channel, reach);
  CHECK(channel.link().field_reach == Approx(reach).epsilon(1e-3));  // the tag hardly loads it
  CHECK(channel.link().field_strength == Approx(nfc_channel::kLeastField).epsilon(1e-3));
}

TEST_CASE("Near by, a frame arrives as it was sent, when it has ended") {
  Channel channel;
  approach_at(channel, kStart, 0.02);
  const nfc::Frame frame = request();
  channel.from_reader(frame);
  const Time end = kStart + nfc::air_time(frame);
  CHECK(channel.next_end() == end);
  CHECK_FALSE(channel.to_tag(0).has_value());
  channel.observe(end - Duration{1});
  CHECK_FALSE(channel.to_tag(0).has_value());
  channel.observe(end);
  CHECK(channel.to_tag(0) == frame);
  CHECK_FALSE(channel.to_tag(0).has_value());
  CHECK_FALSE(channel.next_end().has_value());
  CHECK(pass_up(channel, request(end)) == request(end));
}

TEST_CASE("Each of the four bit rates has its own air time") {
  Channel channel;
  approach(channel, 0.02);
  Time now = kStart;
  for (const std::uint32_t rate : {106, 212, 424, 848}) {
    nfc::Frame frame = request(now);
    frame.bit_rate = rate;
    channel.observe(now);
    channel.from_reader(frame);
    channel.from_tag(0, frame);
    CHECK(channel.next_end() == now + nfc::air_time(frame));
    now = *channel.next_end();
    channel.observe(now);
    CHECK_FALSE(channel.to_tag(0));  // both transmit, neither hears
    CHECK_FALSE(channel.to_reader());
    frame.start = now;
    CHECK(pass_down(channel, frame) == frame);
    now += nfc::air_time(frame);
    frame.start = now;
    CHECK(pass_up(channel, frame) == frame);
    now += nfc::air_time(frame);
  }
}

TEST_CASE("A tag without enough power receives nothing, and without a carrier no tag does") {
  Channel channel;
  approach(channel, 0.2);
  CHECK_FALSE(pass_down(channel, request()).has_value());
  approach(channel, 0.02, 0.0);
  CHECK(channel.link().tag_power == 0.0);
  CHECK_FALSE(pass_down(channel, request(kStart + Duration(1'000'000'000'000))).has_value());
  CHECK_FALSE(pass_up(channel, request(kStart + Duration(2'000'000'000'000))).has_value());
}

TEST_CASE("The threshold decides between hearing and not hearing") {
  Parameters p;
  Channel probe(p);
  approach(probe, 0.06);
  const double rectified = probe.link().tag_voltage - p.tags[0].rectifier_drop;
  p.tags[0].demodulator_voltage = rectified * 0.999;
  Channel hears(p);
  approach(hears, 0.06);
  CHECK(pass_down(hears, request()).has_value());
  p.tags[0].demodulator_voltage = rectified * 1.001;
  Channel deaf(p);
  approach(deaf, 0.06);
  CHECK_FALSE(pass_down(deaf, request()).has_value());
}

TEST_CASE("Bits go wrong as often as the signal-to-noise ratio says, in both directions") {
  Channel channel(sensitive());
  constexpr std::size_t kLength = 200'000;
  for (const double distance : {0.13, 0.135, 0.14}) {
    approach(channel, distance);
    const double probability = channel.link().bit_error_rate_up;
    const std::size_t wrong = ones(pass_up(channel, zeros(kLength)));
    const double sigma = std::sqrt(kLength * probability * (1.0 - probability));
    CHECK(sigma > 1.0);
    CHECK(std::abs(static_cast<double>(wrong) - kLength * probability) < 5.0 * sigma);
    channel.state() = Channel(sensitive()).state();
  }
  approach(channel, 0.17);
  const double probability = channel.link().bit_error_rate_down;
  const std::size_t wrong = ones(pass_down(channel, zeros(kLength)));
  CHECK(wrong > 1000);
  CHECK(std::abs(static_cast<double>(wrong) - kLength * probability) <
        5.0 * std::sqrt(kLength * probability));
}

TEST_CASE("At each bit rate, bits go wrong as often as the link at this rate says") {
  Parameters p;
  p.bit_rate = GENERATE(106, 212, 424, 848);
  Channel channel(p);
  double distance = 0.05;
  do {
    approach(channel, distance += 0.001);
  } while (channel.link().bit_error_rate_up < 0.01);
  constexpr std::size_t kLength = 100'000;
  nfc::Frame frame = zeros(kLength);
  frame.bit_rate = p.bit_rate;
  const double expected = kLength * channel.link().bit_error_rate_up;
  INFO(p.bit_rate << " kbit/s, " << distance << " m, " << expected << " expected");
  CHECK(std::abs(static_cast<double>(ones(pass_up(channel, frame))) - expected) <
        5.0 * std::sqrt(expected));
}

TEST_CASE("While nothing moves it does not matter how the time is cut") {
  const nfc::Frame frame = zeros(400);
  const Time end = kStart + nfc::air_time(frame);
  Channel whole(sensitive());
  approach(whole, 0.17);
  const Heard expected = pass_down(whole, frame);
  REQUIRE(ones(expected) > 10);
  std::mt19937_64 generator(1);
  for (int i = 0; i < 20; ++i) {
    Channel cut(sensitive());
    approach_at(cut, kStart, 0.17);
    cut.from_reader(frame);
    std::uniform_int_distribution<std::int64_t> step(1, (end - kStart).count() / (i + 1));
    for (Time now = kStart; now < end;) {
      now = std::min(end, now + Duration(step(generator)));
      approach_at(cut, now, 0.17);
    }
    CHECK(cut.to_tag(0) == expected);
  }
}

TEST_CASE("Between two instants a bit's signal is interpolated along the power's logarithm") {
  // from 6 cm, where no bit is wrong, to 30 cm, where every second one is
  Parameters p;
  p.tags[0].demodulator_voltage = p.tags[0].rectifier_drop = 0.0;
  Channel channel(p);
  const nfc::Frame frame = zeros(30'000);
  approach_at(channel, kStart, 0.06);
  const double near = std::log(channel.link().snr_down);
  channel.from_reader(frame);
  approach_at(channel, kStart + nfc::air_time(frame), 0.30);
  const double far = std::log(channel.link().snr_down);
  const Heard heard = channel.to_tag(0);

  constexpr std::size_t kPart = 3000;
  for (std::size_t first = 0; first < frame.bits.size(); first += kPart) {
    double expected = 0.0;
    double found = 0.0;
    for (std::size_t i = first; i < first + kPart; ++i) {
      const double share = static_cast<double>(i + 2) / static_cast<double>(frame.bits.size() + 2);
      expected += 0.5 * std::exp(-0.5 * std::exp(near + share * (far - near)));
      found += heard->bits[i];
    }
    CHECK(std::abs(found - expected) < 5.0 * std::sqrt(expected) + 1e-3);
  }
}

TEST_CASE("A tag that loses its power hears the bits until then") {
  Channel channel;
  const nfc::Frame frame = zeros(100);
  approach_at(channel, kStart, 0.02);
  channel.from_reader(frame);
  approach_at(channel, kStart + nfc::air_time(frame), 0.40);
  const Heard heard = channel.to_tag(0);
  REQUIRE(heard.has_value());
  CHECK(heard->bits.size() > 20);
  CHECK(heard->bits.size() < 80);
  CHECK(heard->start == frame.start);
}

TEST_CASE("Power that comes back does not bring the frame back, nor power that comes late") {
  Channel channel;
  const nfc::Frame frame = zeros(100);
  approach_at(channel, kStart, 0.02);
  channel.from_reader(frame);
  approach_at(channel, kStart + 20 * kBit, 0.02);
  approach_at(channel, kStart + 20 * kBit, 0.40);
  approach_at(channel, kStart + 30 * kBit, 0.02);
  channel.observe(kStart + nfc::air_time(frame));
  CHECK(channel.to_tag(0)->bits.size() == 19);

  const Time later = kStart + Duration(1'000'000'000'000);
  approach_at(channel, later, 0.40);
  channel.from_reader(request(later));
  approach_at(channel, later + kBit, 0.02);
  channel.observe(later + nfc::air_time(request()));
  CHECK_FALSE(channel.to_tag(0).has_value());
}

TEST_CASE("The carrier switched off in the middle of an answer ends it there") {
  Channel channel;
  const nfc::Frame frame = request();
  approach_at(channel, kStart, 0.02);
  channel.from_tag(0, frame);
  // the last instant observed before lies bits back: until the switch the old carrier holds
  approach_at(channel, kStart + 10 * kBit + kBit / 2, 0.02, 0.0);
  CHECK(channel.next_end() == kStart + 11 * kBit);
  channel.observe(kStart + 11 * kBit);
  const Heard heard = channel.to_reader();
  REQUIRE(heard.has_value());
  CHECK(heard->bits == nfc::Bits(frame.bits.begin(), frame.bits.begin() + 9));
}

TEST_CASE("A sender that stops sends its frame again, with the bits that got out") {
  Channel channel;
  approach_at(channel, kStart, 0.02);
  nfc::Frame frame = request();
  channel.from_tag(0, frame);
  channel.observe(kStart + 12 * kBit);
  frame.bits.resize(10);
  channel.from_tag(0, frame);
  CHECK_FALSE(channel.next_end().has_value());
  CHECK(channel.to_reader() == frame);

  const Time later = kStart + Duration(1'000'000'000'000);
  frame = request(later);
  channel.observe(later);
  channel.from_reader(frame);
  channel.observe(later + kBit);
  frame.bits.clear();
  channel.from_reader(frame);
  channel.observe(later + nfc::air_time(request()));
  CHECK_FALSE(channel.to_tag(0).has_value());
}

TEST_CASE("Half duplex: what overlaps an own transmission is not received") {
  Channel channel(two_tags());
  approach_at(channel, kStart, 0.02);
  channel.from_reader(request());
  channel.observe(kStart + 5 * kBit);
  channel.from_tag(0, request(kStart + 5 * kBit));
  channel.observe(kStart + 2 * nfc::air_time(request()));
  CHECK_FALSE(channel.to_tag(0).has_value());
  CHECK(channel.to_tag(1) == request());
  CHECK_FALSE(channel.to_reader().has_value());
}

TEST_CASE("Two tags that answer at once collide, and the reader hears it when both have ended") {
  Channel channel(two_tags());
  approach_at(channel, kStart, 0.02);
  const nfc::Frame brief{kStart, 106, nfc::to_bits(nfc::with_crc({0, 1}))};
  const nfc::Frame lengthy{kStart, 106, nfc::to_bits(nfc::with_crc({0, 1, 2, 3}))};
  channel.from_tag(0, brief);
  channel.from_tag(1, lengthy);
  channel.observe(kStart + nfc::air_time(brief));
  CHECK_FALSE(channel.to_reader().has_value());
  CHECK(channel.next_end() == kStart + nfc::air_time(lengthy));
  channel.observe(kStart + nfc::air_time(lengthy));
  const Heard heard = channel.to_reader();
  REQUIRE(heard.has_value());
  CHECK(heard->bits.size() == lengthy.bits.size());
  CHECK_FALSE(nfc::to_bytes(heard->bits).has_value());
  CHECK_FALSE(channel.to_reader().has_value());
}

TEST_CASE("Two tags that answer one after the other are both heard") {
  Channel channel(two_tags());
  approach_at(channel, kStart, 0.02);
  const nfc::Frame second = request(kStart + nfc::air_time(request()));
  channel.from_tag(0, request());
  channel.observe(second.start);
  channel.from_tag(1, second);
  CHECK(channel.to_reader() == request());
  channel.observe(second.start + nfc::air_time(second));
  CHECK(channel.to_reader() == second);
}

TEST_CASE("A frame that enters late, after its end, is heard as if it had entered in time") {
  const nfc::Frame frame = request(kStart + 3 * kBit);
  for (const double distance : {0.02, 0.14}) {
    Channel punctual;
    approach(punctual, distance);
    const Heard expected = pass_up(punctual, frame);
    REQUIRE(expected.has_value());
    Channel late;
    approach_at(late, kStart, distance);
    approach_at(late, kStart + nfc::air_time(frame) + 10 * kBit, distance);
    late.from_tag(0, frame);
    CHECK_FALSE(late.next_end().has_value());
    CHECK(late.to_reader() == expected);
  }
}

TEST_CASE("A frame that enters late is not heard if it began without power, whatever came then") {
  Parameters p;
  Channel probe(p);
  approach(probe, 0.05);
  p.reader.sensitivity = probe.link().signals.up;
  const nfc::Frame frame = request(kStart + 3 * kBit);
  const auto pass = [&](Channel& channel, Time entry) {
    approach_at(channel, kStart, 0.0519);
    if (entry == frame.start) approach_at(channel, entry, 0.0502);
    if (entry == frame.start) channel.from_tag(0, frame);
    approach_at(channel, frame.start + nfc::air_time(frame), 0.04);
    if (entry != frame.start) channel.from_tag(0, frame);
    return channel.to_reader();
  };
  Channel punctual(p);
  CHECK_FALSE(pass(punctual, frame.start).has_value());
  Channel late(p);
  CHECK_FALSE(pass(late, frame.start + nfc::air_time(frame)).has_value());
  p.reader.sensitivity = 1e-12;
  Channel sensitive(p);
  CHECK(pass(sensitive, frame.start + nfc::air_time(frame)) == frame);
}

TEST_CASE("A carrier that goes off where a frame enters late has been on until then") {
  Channel channel;
  const nfc::Frame frame = request(kStart + 3 * kBit);
  approach_at(channel, kStart, 0.02);
  approach_at(channel, kStart + 13 * kBit + kBit / 2, 0.02, 0.0);
  channel.from_tag(0, frame);
  CHECK(channel.next_end() == kStart + 14 * kBit);
  channel.observe(kStart + 14 * kBit);
  CHECK(channel.to_reader()->bits == nfc::Bits(frame.bits.begin(), frame.bits.begin() + 9));
}

TEST_CASE("What began before the last two instants is decided by the earlier of them") {
  Channel channel;
  const nfc::Frame frame = request();
  approach_at(channel, kStart, 0.40);
  approach_at(channel, kStart + kBit, 0.02);
  approach_at(channel, kStart + nfc::air_time(frame), 0.02);
  channel.from_tag(0, frame);
  CHECK(channel.to_reader() == frame);
}

namespace {

/// What two tags and a reader do, by chance.
struct Traffic {
  struct Sent {
    nfc::Frame frame;
    std::size_t sender;  ///< 0 and 1 the tags, 2 the reader
  };
  struct Switch {
    Time time;
    double carrier_power;
  };
  std::vector<Sent> frames;
  std::vector<Switch> switches;
  std::vector<Pose> tags;
  Time end;
};

Traffic random_traffic(std::uint32_t seed) {
  std::mt19937_64 generator(seed);
  const auto pick = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  Traffic traffic;
  traffic.end = kStart + 4000 * kBit;
  traffic.tags = {facing(pick(0.02, 0.08)), facing(pick(0.02, 0.08))};
  for (std::size_t sender = 0; sender < 3; ++sender) {
    Time time = kStart + Duration(static_cast<std::int64_t>(pick(0, 100e6)));
    while (time < traffic.end) {
      nfc::Frame frame{time, 106, nfc::Bits(static_cast<std::size_t>(pick(1, 80)))};
      for (auto& bit : frame.bits) bit = pick(0, 1) < 0.5 ? 0 : 1;
      time += nfc::air_time(frame);
      time += Duration(static_cast<std::int64_t>(sender == 2 ? pick(0, 4e9) : pick(0, 1e9)));
      traffic.frames.push_back({frame, sender});
    }
  }
  for (Time time = kStart; time < traffic.end;) {
    traffic.switches.push_back({time, traffic.switches.size() % 4 == 3 ? 0.0 : 0.5});
    time += Duration(static_cast<std::int64_t>(pick(1e8, 5e9)));
  }
  return traffic;
}

/// All that is heard, in the order of its receivers, in steps of 1 ms; a tag that is not punctual
/// hands its frames over where a step ends.
std::vector<std::vector<nfc::Frame>> heard(const Traffic& traffic, bool punctual) {
  Channel channel(two_tags());
  std::vector<std::vector<nfc::Frame>> heard(3);
  double carrier_power = 0.5;
  Time last = kStart - Duration(1);
  for (Time now = kStart; now < traffic.end + 200 * kBit;) {
    for (const auto& change : traffic.switches) {
      if (change.time == now) carrier_power = change.carrier_power;
    }
    channel.move(Pose{}, traffic.tags, carrier_power);
    channel.observe(now);
    for (const auto& [frame, sender] : traffic.frames) {
      if (frame.start <= last || frame.start > now) continue;
      sender == 2 ? channel.from_reader(frame) : channel.from_tag(sender, frame);
    }
    for (std::size_t tag = 0; tag < 2; ++tag) {
      while (const Heard frame = channel.to_tag(tag)) heard[tag].push_back(*frame);
    }
    while (const Heard frame = channel.to_reader()) heard[2].push_back(*frame);
    last = now;

    constexpr Duration kStep{1'000'000'000};
    Time next = kStart + kStep * ((now - kStart) / kStep + 1);
    if (const auto end = channel.next_end()) next = std::min(next, *end);
    for (const auto& change : traffic.switches) {
      if (change.time > now) next = std::min(next, change.time);
    }
    for (const auto& [frame, sender] : traffic.frames) {
      if (frame.start > now && (punctual || sender == 2)) next = std::min(next, frame.start);
    }
    now = next;
  }
  for (auto& frames : heard) {
    std::sort(frames.begin(), frames.end(),
              [](const auto& a, const auto& b) { return a.start < b.start; });
  }
  return heard;
}

}  // namespace

TEST_CASE("While nothing moves it does not matter whether tags hand their frames over in time") {
  const std::uint32_t seed = GENERATE(range(1, 9));
  const Traffic traffic = random_traffic(seed);
  const auto punctual = heard(traffic, true);
  INFO("seed " << seed);
  REQUIRE(punctual[0].size() + punctual[1].size() > 0);
  REQUIRE(punctual[2].size() > 5);
  const auto late = heard(traffic, false);
  for (std::size_t i = 0; i < 3; ++i) {
    INFO("receiver " << i);
    CHECK(late[i] == punctual[i]);
  }
}

TEST_CASE("A much stronger tag masks a weaker one, which is noise to it") {
  Channel channel(two_tags());
  const nfc::Frame strong = request();
  const nfc::Frame weak{kStart, 106, nfc::to_bits(nfc::with_crc({0, 1}))};
  channel.move(Pose{}, {facing(0.02), facing(0.09)}, 0.5);
  channel.observe(kStart);
  channel.from_tag(0, strong);
  channel.from_tag(1, weak);
  channel.observe(kStart + nfc::air_time(weak));
  CHECK(channel.to_reader() == strong);

  // 7 dB apart, some bits of a long frame are wrong
  Parameters sharp = two_tags();
  sharp.reader.capture_ratio = 6.0;
  Channel close(sharp);
  close.move(Pose{}, {facing(0.04), facing(0.06)}, 0.5);
  CHECK(decibels(close.link(0).signals.up / close.link(1).signals.up) == Approx(7.5).margin(1.0));
  close.observe(kStart);
  close.from_tag(0, zeros(20'000));
  close.from_tag(1, zeros(20'000));
  close.observe(kStart + nfc::air_time(zeros(20'000)));
  CHECK(ones(close.to_reader()) > 0);
}

TEST_CASE("Each tag hears the reader's frame with errors of its own") {
  Channel channel(sensitive(2));
  approach_at(channel, kStart, 0.17);
  channel.from_reader(zeros(500));
  channel.observe(kStart + nfc::air_time(zeros(500)));
  const Heard first = channel.to_tag(0);
  const Heard second = channel.to_tag(1);
  CHECK(ones(first) > 0);
  CHECK(ones(second) > 0);
  CHECK_FALSE(first == second);
}

TEST_CASE("Tags do not load each other") {
  Channel alone;
  approach(alone, 0.02);
  Channel both(two_tags());
  approach(both, 0.02);
  CHECK(both.link(0).tag_power == alone.link().tag_power);
  CHECK(both.link(1).tag_power == alone.link().tag_power);
}

TEST_CASE("Each frame has errors of its own, and a restored state repeats them") {
  Channel channel;
  approach(channel, 0.14);
  const auto send = [&] { return pass_up(channel, zeros(500)); };
  channel.observe(kStart);
  const Channel::State at_start = channel.state();
  const Heard first = send();
  channel.state().observed.clear();
  const Channel::State saved = channel.state();
  const Heard second = send();
  CHECK_FALSE(first == second);
  channel.state() = saved;
  CHECK(send() == second);
  channel.state() = at_start;
  CHECK(send() == first);
}

TEST_CASE("A state that is saved with a frame on the air goes on with it") {
  Channel channel(sensitive());
  approach_at(channel, kStart, 0.17);
  channel.from_reader(zeros(300));
  channel.observe(kStart + 100 * kBit);
  const Channel::State saved = channel.state();
  channel.observe(kStart + nfc::air_time(zeros(300)));
  const Heard expected = channel.to_tag(0);
  Channel other(sensitive());
  approach(other, 0.17);
  other.state() = saved;
  other.observe(kStart + nfc::air_time(zeros(300)));
  CHECK(other.to_tag(0) == expected);
}

TEST_CASE("The seed decides the errors, and one direction does not disturb the other") {
  Parameters p;
  Channel first(p);
  Channel same(p);
  p.seed = 2;
  Channel other(p);
  for (Channel* channel : {&first, &same, &other}) approach(*channel, 0.14);
  same.observe(kStart - nfc::air_time(zeros(50)));
  nfc::Frame before = zeros(50);
  before.start -= nfc::air_time(before);
  pass_down(same, before);
  const Heard errors = pass_up(first, zeros(500));
  CHECK(pass_up(same, zeros(500)) == errors);
  CHECK_FALSE(pass_up(other, zeros(500)) == errors);
}

TEST_CASE("A parameter out of its range is named") {
  const auto with = [](auto change) {
    Parameters p = two_tags();
    change(p);
    return refusal(p);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({}) == "accepted");
  CHECK_THAT(with([](auto& p) { p.reader.coil.radius = 0.0; }),
             Catch::Contains("reader_coil.radius is 0: expected more than 0"));
  CHECK_THAT(with([](auto& p) { p.tags[1].coil.wire_radius = 0.007; }),
             Catch::Contains("window.coil.wire_radius") && Catch::Contains("half the coil's"));
  CHECK_THAT(with([](auto& p) { p.tags[0].coil.inductance = -1e-6; }),
             Catch::Contains("door.coil.inductance"));
  CHECK_THAT(with([](auto& p) { p.tags[0].coil.quality_factor = 0.0; }),
             Catch::Contains("door.coil.quality_factor"));
  CHECK_THAT(with([](auto& p) { p.tags[0].coil.turns = -1.0; }),
             Catch::Contains("door.coil.turns"));
  CHECK_THAT(with([](auto& p) { p.tags[0].chip.capacitance = -1e-12; }),
             Catch::Contains("door.capacitance is -1e-12: expected 0 or more"));
  CHECK_THAT(with([](auto& p) { p.reader.capacitance = -1e-12; }),
             Catch::Contains("reader.capacitance"));
  CHECK_THAT(with([](auto& p) { p.tags[0].rectifier_drop = -0.1; }),
             Catch::Contains("door.rectifier_drop"));
  CHECK_THAT(with([](auto& p) { p.tags[0].chip.voltage_limit = 0.0; }),
             Catch::Contains("door.voltage_limit"));
  CHECK_THAT(with([](auto& p) { p.tags[0].chip.modulation_resistance = 0.0; }),
             Catch::Contains("door.modulation_resistance"));
  CHECK_THAT(with([nan](auto& p) { p.tags[0].demodulator_voltage = nan; }),
             Catch::Contains("door.demodulator_voltage"));
  CHECK_THAT(with([](auto& p) { p.reader.noise.interference = -1.0; }),
             Catch::Contains("reader.interference"));
  CHECK_THAT(with([](auto& p) { p.reader.capture_ratio = -1.0; }),
             Catch::Contains("reader.capture_ratio"));
  CHECK_THAT(with([](auto& p) { p.bit_rate = 300; }),
             Catch::Contains("bit_rate is 300: expected 106, 212, 424 or 848 kbit/s"));
  CHECK_THAT(with([](auto& p) { p.tags.clear(); }), Catch::Contains("expected one at least"));
  Parameters only;
  only.tags[0].coil.radius = -1.0;
  CHECK_THAT(refusal(only), Catch::Contains("tag_coil.radius"));
}

TEST_CASE("Inputs that make no sense are refused") {
  Channel channel(two_tags());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Pose> poses = {facing(0.02), facing(0.02)};
  CHECK_THROWS_WITH(channel.move(Pose{}, poses, -0.1), Catch::Contains("carrier_power"));
  CHECK_THROWS_WITH(channel.move(Pose{}, poses, nan), Catch::Contains("carrier_power"));
  CHECK_THROWS_WITH(channel.move(facing(nan), poses, 0.5),
                    Catch::Contains("position of reader_coil"));
  CHECK_THROWS_WITH(channel.move(Pose{}, {facing(0.02), facing(nan)}, 0.5),
                    Catch::Contains("position of window.coil"));
  Pose flat = facing(0.02);
  flat.axis.setZero();
  CHECK_THROWS_WITH(channel.move(Pose{}, {flat, facing(0.02)}, 0.5),
                    Catch::Contains("axis of door.coil"));
  flat.axis = Eigen::Vector3d(0.0, nan, 1.0);
  CHECK_THROWS_WITH(channel.move(flat, poses, 0.5), Catch::Contains("axis of reader_coil"));
  approach_at(channel, kStart, 0.02);
  CHECK_THROWS_WITH(channel.from_reader(request(Time::max())), Catch::Contains("begins"));
}
