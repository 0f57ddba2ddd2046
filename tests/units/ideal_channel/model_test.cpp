#include "units/ideal_channel/model.h"

#include <limits>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

using namespace ideal_channel;
using stride::Duration;
using stride::Time;

namespace {

const Time kStart = stride::time_from_seconds(1.5);

Pose away(double distance) { return {{0, 0, distance}, {0, 0, 1}}; }

nfc::Frame frame(const nfc::Bytes& bytes, Time start = kStart) {
  return {start, 106, nfc::to_bits(nfc::with_crc(bytes))};
}

Time end_of(const nfc::Frame& frame) { return frame.start + nfc::air_time(frame); }

}  // namespace

TEST_CASE("A frame arrives as it was sent, when it has ended, however far it is") {
  Channel channel;
  channel.move({}, {away(1e6)}, 0.0);
  channel.observe(kStart);
  const nfc::Frame sent = frame({1, 2, 3});
  channel.from_reader(sent);
  CHECK(channel.next_end() == end_of(sent));
  channel.observe(end_of(sent) - Duration{1});
  CHECK_FALSE(channel.to_tag(0));
  channel.observe(end_of(sent));
  CHECK(channel.to_tag(0) == sent);
  CHECK(channel.is_quiet());
}

TEST_CASE("Both sides, and several tags, may send at once") {
  Parameters parameters;
  parameters.tags = {{"door"}, {"window"}};
  Channel channel(parameters);
  channel.move({}, {away(1), away(1)}, 0.5);
  channel.observe(kStart);
  channel.from_reader(frame({1}));
  channel.from_tag(0, frame({2}));
  channel.from_tag(1, frame({3}));
  channel.observe(end_of(frame({1})));
  CHECK(channel.to_tag(0) == frame({1}));
  CHECK(channel.to_tag(1) == frame({1}));
  CHECK(channel.to_reader() == frame({2}));
  CHECK(channel.to_reader() == frame({3}));
  CHECK_FALSE(channel.to_reader());
}

TEST_CASE("What is cut off arrives cut off") {
  Channel channel;
  channel.move({}, {away(1)}, 0.5);
  channel.observe(kStart);
  nfc::Frame sent = frame({1, 2, 3});
  channel.from_tag(0, sent);
  channel.observe(kStart + 6 * nfc::bit_duration(106));
  sent.bits.resize(5);
  channel.from_tag(0, sent);
  CHECK(channel.next_end() == end_of(sent));
  channel.observe(end_of(sent));
  CHECK(channel.to_reader() == sent);
}

TEST_CASE("Power comes while the carrier is on, the same at any distance") {
  Channel channel;
  channel.move({}, {away(0.01)}, 1e-6);
  CHECK(channel.link().tag_power == 5e-3);
  channel.move({}, {away(1e3)}, 2.0);
  CHECK(channel.link().distance == 1e3);
  CHECK(channel.link().tag_power == 5e-3);
  channel.move({}, {away(0.01)}, 0.0);
  CHECK(channel.link().tag_power == 0.0);
}

TEST_CASE("Beyond a range there is nothing, and what leaves it is lost") {
  Parameters parameters;
  parameters.range = 2.0;
  Channel channel(parameters);
  channel.move({}, {away(2.5)}, 0.5);
  channel.observe(kStart);
  CHECK(channel.link().tag_power == 0.0);
  channel.from_reader(frame({1}));
  channel.observe(end_of(frame({1})));
  CHECK_FALSE(channel.to_tag(0));

  const Time later = kStart + Duration{1'000'000'000'000};
  channel.move({}, {away(2.0)}, 0.5);
  channel.observe(later);
  CHECK(channel.link().tag_power == 5e-3);
  channel.from_reader(frame({1, 2}, later));
  channel.observe(later + 10 * nfc::bit_duration(106));
  channel.move({}, {away(2.1)}, 0.5);
  channel.observe(later + 10 * nfc::bit_duration(106));
  channel.observe(end_of(frame({1, 2}, later)));
  const auto heard = channel.to_tag(0);
  REQUIRE(heard);
  CHECK(heard->bits.size() == 9);
}

TEST_CASE("A parameter out of its range is refused") {
  Parameters parameters;
  parameters.range = -1.0;
  CHECK_THROWS_WITH(Channel(parameters), Catch::Contains("range is -1"));
  parameters.range = 0.0;
  parameters.delivered_power = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(Channel(parameters), Catch::Contains("delivered_power is nan"));
  parameters = {};
  parameters.tags.clear();
  CHECK_THROWS_WITH(Channel(parameters), Catch::Contains("no tag"));
}
