#include "units/channel/reception.h"

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

#include "tests/units/channel/answer.h"

using namespace channel::tests;
using channel::nominal_transit;
using channel::Reception;
using channel::Transit;
using nfc::Bits;
using nfc::Bytes;
using nfc::Frame;
using stride::Duration;
using stride::Time;

namespace {

Reception nominal(const Frame& frame, std::uint32_t tag = 0) {
  return {frame, nominal_transit(frame), tag, 0};
}

/// Stored until its sender has handed it over, then a header of 2 bits and symbols of 4 in 16 us.
Reception packet(const Frame& frame) {
  Transit transit;
  transit.begin = frame.start + nfc::air_time(frame);
  transit.header = Duration{192'000'000};
  transit.symbol = Duration{16'000'000};
  transit.bits_per_symbol = 4;
  transit.header_bits = 16;
  transit.delay = transit.end_of_bits(frame.bits.size()) - transit.begin;
  transit.is_stored = true;
  return {frame, transit, 0, 0};
}

}  // namespace

TEST_CASE("The first bit ends after the start of communication, the last one bit before the end") {
  Reception reception = nominal(answer({1, 2}));
  CHECK(reception.next_instant() == kStart + 2 * kBit);
  reception.heard = reception.sent.bits;
  CHECK(reception.complete());
  CHECK(reception.end == kStart + nfc::air_time(reception.sent));
  CHECK(reception.next_instant() == reception.end);
}

TEST_CASE("Frames overlap while both are on the air, not where one begins as the other ends") {
  const Reception first = nominal(answer({1}));
  CHECK(first.overlaps(nominal(answer({1}, first.end - Duration{1}), 1)));
  CHECK_FALSE(first.overlaps(nominal(answer({1}, first.end), 1)));
}

TEST_CASE("A frame that is cut ends with the bits that got out, or sooner") {
  const Bits few = {1, 0, 1};
  Reception reception = nominal(answer({1, 2}));
  reception.heard = {1, 0, 1, 1, 0};
  reception.cut(few);
  CHECK(reception.sent.bits == few);
  CHECK(reception.heard.size() == 3);
  CHECK(reception.end == kStart + 5 * kBit);
  reception.end = kStart + 4 * kBit;  // with the carrier
  reception.cut(few);
  CHECK(reception.end == kStart + 4 * kBit);
}

TEST_CASE("Without the carrier a frame ends with what was heard, once and for all") {
  Reception reception = nominal(answer({1, 2}));
  reception.heard = {1, 0, 1};
  reception.end_with_carrier(kStart + 4 * kBit + kBit / 2);
  CHECK(reception.lost);
  CHECK(reception.end == kStart + 5 * kBit);
  reception.end_with_carrier(kStart + 6 * kBit);
  CHECK(reception.end == kStart + 5 * kBit);
}

TEST_CASE("A packet's bits are decided at the ends of its symbols, its header before them") {
  Reception reception = packet({kStart, 106, {1, 0, 1, 1, 0, 1}});
  const Time begin = kStart + 8 * kBit;
  const Duration symbol = reception.transit.symbol;
  CHECK(reception.end == begin + reception.transit.header + 2 * symbol);
  CHECK_FALSE(reception.has_header);
  CHECK(reception.next_instant() == begin + reception.transit.header);
  reception.has_header = true;
  CHECK(reception.next_instant() == begin + reception.transit.header + symbol);
  reception.heard = {1, 0, 1, 1};
  CHECK(reception.next_instant() == reception.end);
}

TEST_CASE("A receiver gets a packet as if it came with a delay") {
  Reception reception = packet(answer({1, 2}));
  reception.heard = reception.sent.bits;
  const Frame heard = reception.heard_frame();
  CHECK(heard.bits == reception.sent.bits);
  CHECK(heard.start + nfc::air_time(heard) == reception.end);
}

TEST_CASE("A packet whose sender stops before it has all of it is not sent") {
  Reception reception = packet(answer({1, 2}));
  reception.cut({1, 0, 1});
  CHECK_FALSE(reception.is_heard());
  CHECK(reception.end == reception.transit.begin);
  CHECK_FALSE(reception.overlaps(packet(answer({1, 2}))));
}

TEST_CASE("A receiver listens to the packet whose header it has heard, to its end") {
  Reception reception = packet(answer({1, 2}));
  const Time begin = reception.transit.begin;
  CHECK_FALSE(reception.keeps_busy_at(begin + Duration{1}));
  reception.has_header = true;
  CHECK_FALSE(reception.keeps_busy_at(begin));
  CHECK(reception.keeps_busy_at(begin + Duration{1}));
  CHECK(reception.keeps_busy_at(reception.end - Duration{1}));
  CHECK_FALSE(reception.keeps_busy_at(reception.end));
  reception.deaf = true;
  CHECK_FALSE(reception.keeps_busy_at(begin + Duration{1}));
}

TEST_CASE("Frames that have ended are taken in order, each tag's own") {
  std::vector<Reception> all = {nominal(answer({1}), 0), nominal(answer({2}), 1),
                                nominal(answer({3}), 0)};
  for (Reception& reception : all) reception.heard = reception.sent.bits;
  all[0].deaf = true;
  CHECK_FALSE(take_ended(all, all[0].end - Duration{1}).has_value());
  CHECK(take_ended(all, all[0].end, 0) == answer({3}));
  REQUIRE(all.size() == 1);
  CHECK(take_ended(all, all[0].end, 0) == std::nullopt);
  CHECK(take_ended(all, all[0].end) == answer({2}));
  CHECK(all.empty());
}
