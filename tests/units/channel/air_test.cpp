// The rules of the air with a technology that has nothing but a signal and an error rate.
#include "units/channel/air.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

#include "units/channel/superposition.h"

using namespace channel;
using stride::Duration;
using stride::Time;

namespace {

const Time kAirStart = stride::time_from_seconds(1.0);
const Duration kAirBit = nfc::bit_duration(106);

/// Signals as they are set; a bit is wrong where the others are stronger.
class Plain : public Air {
 public:
  explicit Plain(const Rules& rules = {}, std::size_t tags = 2)
      : Air(tags, rules, 1), signals_of(tags, {1.0, 1.0}) {}

  std::vector<Signals> signals_of;
  double carrier = 1.0;
  double error_rate = 0.0;
  std::optional<Duration> header;  ///< of a packet that begins when the frame has ended

 protected:
  double carrier_power() const override { return carrier; }
  Signals signals(std::size_t tag, double carrier_power) const override {
    return {signals_of[tag].down * carrier_power, signals_of[tag].up * carrier_power};
  }
  double least_signal(Direction, std::size_t) const override { return 1e-3; }
  double bit_error_probability(Direction, std::size_t, std::uint32_t, double signal,
                               double others) const override {
    return others > signal ? 0.5 : error_rate;
  }
  Transit transit(const nfc::Frame& frame, std::size_t tag, Time free) const override {
    Transit transit = Air::transit(frame, tag, free);
    if (!header) return transit;
    transit.begin = std::max(free, frame.start + nfc::air_time(frame));
    transit.header = *header;
    transit.header_bits = 8;
    transit.trailer = {};
    transit.delay = transit.end_of_bits(frame.bits.size()) - (frame.start + nfc::air_time(frame));
    return transit;
  }
};

Rules rules(Overlap overlap, double capture_ratio = 1.0) {
  Rules rules;
  rules.overlap = overlap;
  rules.capture_ratio = capture_ratio;
  return rules;
}

nfc::Frame frame(const nfc::Bytes& bytes, Time start = kAirStart) {
  return {start, 106, nfc::to_bits(nfc::with_crc(bytes))};
}

Time end_of(const nfc::Frame& frame) { return frame.start + nfc::air_time(frame); }

}  // namespace

TEST_CASE(
    "Superposed, answers that overlap are one message; a weak one is masked by a strong one") {
  Plain air(rules(Overlap::Superpose, 10.0));
  air.observe(kAirStart);
  air.from_tag(0, frame({1, 2}));
  air.from_tag(1, frame({1, 3}));
  air.observe(end_of(frame({1, 2})));
  CHECK(air.to_reader() == superposed({frame({1, 2}), frame({1, 3})}));
  CHECK_FALSE(air.to_reader());

  const Time later = kAirStart + 1000 * kAirBit;
  air.signals_of[1].up = 0.05;
  air.observe(later);
  air.from_tag(0, frame({1, 2}, later));
  air.from_tag(1, frame({1, 3}, later));
  air.observe(end_of(frame({1, 2}, later)));
  CHECK(air.to_reader() == frame({1, 2}, later));
  CHECK_FALSE(air.to_reader());
}

TEST_CASE("Interfering, each is heard by itself, and the strong disturb the weak") {
  Plain air(rules(Overlap::Interfere));
  air.signals_of[1].up = 0.5;
  air.observe(kAirStart);
  air.from_tag(0, frame({1, 2}));
  air.from_tag(1, frame({1, 3}));
  air.observe(end_of(frame({1, 2})));
  CHECK(air.to_reader() == frame({1, 2}));
  const auto weak = air.to_reader();
  REQUIRE(weak);
  CHECK(weak->bits != frame({1, 3}).bits);
}

TEST_CASE(
    "Passing, all arrive, also while their receiver sends, if it need not be quiet for that") {
  Rules all = rules(Overlap::Pass);
  for (const bool half_duplex : {true, false}) {
    all.half_duplex = half_duplex;
    Plain air(all);
    air.observe(kAirStart);
    air.from_tag(0, frame({1, 2}));
    air.from_tag(1, frame({1, 3}));
    air.from_reader(frame({4}, kAirStart + kAirBit));
    air.observe(end_of(frame({1, 2, 3, 4})));
    CHECK(air.to_reader().has_value() == !half_duplex);
    CHECK(air.to_reader().has_value() == !half_duplex);
    CHECK(air.to_tag(0).has_value() == !half_duplex);
    CHECK(air.to_tag(1).has_value() == !half_duplex);
    CHECK(air.is_quiet());
  }
}

TEST_CASE("A header that is wrong loses its packet, and leaves the receiver to the next") {
  const auto heard = [](double error_rate) {
    Plain air(rules(Overlap::Interfere));
    air.header = 16 * kAirBit;
    air.observe(kAirStart);
    air.error_rate = error_rate;
    air.from_tag(0, frame({1, 2, 3}));
    air.from_tag(1, frame({5, 6, 7}, kAirStart + 30 * kAirBit));
    air.observe(kAirStart + 65 * kAirBit);  // after the first packet's header
    CHECK(air.next_end());                  // which is decided by now
    air.error_rate = 0.0;
    air.observe(kAirStart + 300 * kAirBit);
    std::vector<nfc::Bits> all;
    while (const auto frame = air.to_reader()) all.push_back(frame->bits);
    return all;
  };
  CHECK(heard(0.0) == std::vector<nfc::Bits>{frame({1, 2, 3}).bits});
  CHECK(heard(0.99) == std::vector<nfc::Bits>{frame({5, 6, 7}).bits});
}

TEST_CASE("Packets of one sender follow each other, those of two are distinguished") {
  Plain air(rules(Overlap::Interfere));
  air.header = 100 * kAirBit;
  air.observe(kAirStart);
  air.from_tag(0, frame({1}));
  air.from_tag(0, frame({2}, end_of(frame({1}))));
  CHECK(air.next_end() == end_of(frame({1})) + (100 + 27) * kAirBit);
  air.observe(*air.next_end());
  CHECK(air.to_reader()->bits == frame({1}).bits);
  CHECK(air.next_end() == end_of(frame({1})) + 2 * (100 + 27) * kAirBit);
  air.observe(*air.next_end());
  CHECK(air.to_reader()->bits == frame({2}).bits);
}

TEST_CASE("A signal that falls below what is needed, or its carrier, ends what is heard for good") {
  for (const bool with_carrier : {false, true}) {
    Plain air;
    air.observe(kAirStart);
    air.from_reader(frame({1, 2, 3}));
    air.observe(kAirStart + 10 * kAirBit);
    if (with_carrier) air.carrier = 0.0;
    if (!with_carrier) air.signals_of[0].down = air.signals_of[1].down = 1e-4;
    air.observe(kAirStart + 10 * kAirBit);
    air.carrier = 1.0;
    air.signals_of[0].down = 1.0;
    air.observe(kAirStart + 11 * kAirBit);
    air.observe(end_of(frame({1, 2, 3})));
    const auto heard = air.to_tag(0);
    REQUIRE(heard);
    CHECK(heard->bits.size() == 9);
  }
}

TEST_CASE("A frame from another hour is refused") {
  Plain air;
  air.observe(kAirStart);
  CHECK_THROWS_WITH(air.from_reader(frame({1}, stride::time_from_seconds(4000))),
                    Catch::Contains("a frame begins at 4000"));
}
