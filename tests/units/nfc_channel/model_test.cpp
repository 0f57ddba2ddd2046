#include "units/nfc_channel/model.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "units/nfc/iso14443a.h"

using namespace nfc_channel;

namespace {

constexpr double kBitRate = 13.56e6 / 128.0;

void approach(Channel& channel, double distance, double power = 0.5) {
  channel.move(Pose{}, {{0.0, 0.0, distance}, {0.0, 0.0, -1.0}}, power);
}

nfc::Frame request() {
  return {stride::time_from_seconds(14.2), 106, nfc::to_bits(nfc::with_crc({0x02}))};
}

nfc::Frame zeros(std::size_t length) { return {stride::Time{}, 106, nfc::Bits(length, 0)}; }

std::size_t ones(const std::optional<nfc::Frame>& frame) {
  std::size_t count = 0;
  for (const auto bit : frame.value().bits) count += bit;
  return count;
}

std::string refusal(Parameters parameters) {
  try {
    Channel channel(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("With the default antennas the tag lives on milliwatts near by and starves at 10 cm") {
  Channel channel;
  approach(channel, 0.035);
  CHECK(channel.link().tag_power > 1e-3);
  CHECK(channel.link().distance == Approx(0.035));
  approach(channel, 0.10);
  CHECK(channel.link().tag_power < 50e-6);
  CHECK(channel.link().tag_power > 0.0);
}

TEST_CASE("Power to the tag is that of the carrier times efficiency and match, up to the limit") {
  Parameters p;
  Channel channel(p);
  approach(channel, 0.05, 0.8);
  const double efficiency = link_efficiency(channel.link().coupling, 10.0, 10.0);
  CHECK(channel.link().tag_power == Approx(0.8 * 0.2 * efficiency));
  approach(channel, 0.005, 1.0);
  CHECK(channel.link().tag_power == p.tag_power_limit);
  CHECK(channel.link().down.signal_power > p.tag_power_limit);
}

TEST_CASE("The answer takes the way back: the reader gets P (m g)^2") {
  Channel channel;
  approach(channel, 0.05, 0.8);
  const double gain = channel.link().down.signal_power / 0.8;
  CHECK(channel.link().up.signal_power == Approx(0.8 * 0.01 * gain * gain));
}

TEST_CASE("Near by, a frame arrives as it was sent, start included") {
  Channel channel;
  approach(channel, 0.02);
  CHECK(channel.to_tag(request()) == request());
  CHECK(channel.to_reader(request()) == request());
}

TEST_CASE("A tag without enough power hears nothing, and without a carrier nobody does") {
  Channel channel;
  approach(channel, 0.12);
  CHECK_FALSE(channel.to_tag(request()).has_value());
  approach(channel, 0.02, 0.0);
  CHECK(channel.link().tag_power == 0.0);
  CHECK_FALSE(channel.to_tag(request()).has_value());
  CHECK_FALSE(channel.to_reader(request()).has_value());
}

TEST_CASE("The threshold decides between hearing and not hearing") {
  Parameters p;
  Channel probe(p);
  approach(probe, 0.06);
  p.tag_power_threshold = probe.link().tag_power * 0.999;
  Channel hears(p);
  approach(hears, 0.06);
  CHECK(hears.to_tag(request()).has_value());
  p.tag_power_threshold = probe.link().tag_power * 1.001;
  Channel deaf(p);
  approach(deaf, 0.06);
  CHECK_FALSE(deaf.to_tag(request()).has_value());
}

TEST_CASE("Even with no thresholds a dead field carries no frame") {
  Parameters p;
  p.tag_power_threshold = 0.0;
  p.reader_sensitivity = 0.0;
  Channel channel(p);
  approach(channel, 0.02, 0.0);
  CHECK_FALSE(channel.to_tag(request()).has_value());
  CHECK_FALSE(channel.to_reader(request()).has_value());
}

TEST_CASE("Bits go wrong as often as the signal-to-noise ratio says, in both directions") {
  Channel channel;
  constexpr std::size_t kLength = 300'000;
  for (const double distance : {0.062, 0.066, 0.070}) {
    approach(channel, distance);
    const double probability = bit_error_probability(channel.snr_up(kBitRate));
    const std::size_t wrong = ones(channel.to_reader(zeros(kLength)));
    const double sigma = std::sqrt(kLength * probability * (1.0 - probability));
    CHECK(std::abs(static_cast<double>(wrong) - kLength * probability) < 5.0 * sigma);
    CHECK(sigma > 1.0);
  }

  Parameters noisy;
  noisy.tag_noise.interference = 1e-4;
  Channel down(noisy);
  approach(down, 0.05);
  const double probability = bit_error_probability(down.snr_down(kBitRate));
  const std::size_t wrong = ones(down.to_tag(zeros(kLength)));
  CHECK(std::abs(static_cast<double>(wrong) - kLength * probability) <
        5.0 * std::sqrt(kLength * probability));
  CHECK(wrong > 0);
}

TEST_CASE("Each frame has errors of its own, and a restored state repeats them") {
  Channel channel;
  approach(channel, 0.07);
  const auto first = channel.to_reader(zeros(500));
  const Channel::State saved = channel.state();
  const auto second = channel.to_reader(zeros(500));
  const auto third = channel.to_reader(zeros(500));
  CHECK_FALSE(first == second);
  CHECK_FALSE(second == third);
  channel.state() = saved;
  CHECK(channel.to_reader(zeros(500)) == second);
  CHECK(channel.to_reader(zeros(500)) == third);
}

TEST_CASE("The seed decides the errors, and one direction does not disturb the other") {
  Parameters p;
  Channel first(p);
  Channel same(p);
  p.seed = 2;
  Channel other(p);
  for (Channel* channel : {&first, &same, &other}) approach(*channel, 0.07);
  same.to_tag(zeros(500));
  const auto errors = first.to_reader(zeros(500));
  CHECK(same.to_reader(zeros(500)) == errors);
  CHECK_FALSE(other.to_reader(zeros(500)) == errors);
}

TEST_CASE("A parameter out of its range is named") {
  const auto with = [](auto change) {
    Parameters p;
    change(p);
    return refusal(p);
  };
  CHECK(refusal({}) == "accepted");
  CHECK_THAT(with([](auto& p) { p.reader_coil.radius = 0.0; }),
             Catch::Contains("reader_coil.radius") && Catch::Contains("more than 0"));
  CHECK_THAT(with([](auto& p) { p.tag_coil.wire_radius = 0.014; }),
             Catch::Contains("tag_coil.wire_radius") && Catch::Contains("half the coil's radius"));
  CHECK_THAT(with([](auto& p) { p.tag_coil.inductance = -1e-6; }),
             Catch::Contains("tag_coil.inductance"));
  CHECK_THAT(with([](auto& p) { p.tag_coil.quality_factor = 0.0; }),
             Catch::Contains("tag_coil.quality_factor"));
  CHECK_THAT(with([](auto& p) { p.modulation_depth = 1.1; }),
             Catch::Contains("tag.modulation_depth") && Catch::Contains("0 to 1"));
  CHECK_THAT(with([](auto& p) { p.load_match = -0.1; }), Catch::Contains("tag.load_match"));
  CHECK_THAT(with([](auto& p) { p.tag_power_limit = 0.0; }), Catch::Contains("tag.power_limit"));
  CHECK_THAT(
      with([](auto& p) { p.tag_power_threshold = std::numeric_limits<double>::quiet_NaN(); }),
      Catch::Contains("tag.power_threshold"));
  CHECK_THAT(with([](auto& p) { p.reader_noise.interference = -1.0; }),
             Catch::Contains("reader.interference"));
}

TEST_CASE("Inputs that make no sense are refused") {
  Channel channel;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(channel.move(Pose{}, Pose{}, -0.1), Catch::Contains("carrier_power"));
  CHECK_THROWS_WITH(channel.move(Pose{}, Pose{}, nan), Catch::Contains("carrier_power"));
  CHECK_THROWS_WITH(approach(channel, nan), Catch::Contains("position"));
}
