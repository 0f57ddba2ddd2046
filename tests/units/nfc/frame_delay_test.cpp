#include <cmath>

#include <catch2/catch.hpp>

#include <stride/nfc/frame_delay.h>

using nfc::answer_start;
using nfc::first_answer_start;
using stride::Duration;
using stride::Time;

namespace {

constexpr double kCarrier = 13.56e6;
const Time kStart(Duration(1'234'567'890'123));

nfc::Frame frame_of(const nfc::Bits& bits) { return {kStart, 106, bits}; }

/// From the request's start on, in carrier periods.
double periods_to(Time time) { return stride::to_seconds(time - kStart) * kCarrier; }

/// Where the last pause of modified Miller code ends, by the sequences X, Y and Z of ISO/IEC
/// 14443-2 8.1.3: start of communication, the bits, and the zero that begins the end of
/// communication.
double end_of_last_pause(const nfc::Bits& bits) {
  nfc::Bits all = {0};
  all.insert(all.end(), bits.begin(), bits.end());
  all.push_back(0);
  double end = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool after_one = i > 0 && all[i - 1] == 1;
    const double bit = 128.0 * static_cast<double>(i);
    if (all[i] == 1) end = bit + 64 + 32;
    if (all[i] == 0 && !after_one) end = bit + 32;
  }
  return end;
}

}  // namespace

TEST_CASE("the frame delay counts from the end of the last pause, 1236 or 1172 carrier periods") {
  for (const nfc::Bits& bits : {nfc::Bits{1, 0, 1}, nfc::Bits{0, 0, 1, 1}}) {
    const double delay = periods_to(first_answer_start(frame_of(bits))) - end_of_last_pause(bits);
    CHECK(delay == Approx(1236).margin(1e-4));
  }
  for (const nfc::Bits& bits : {nfc::Bits{1, 1, 0}, nfc::Bits{0, 0}, nfc::Bits{}}) {
    const double delay = periods_to(first_answer_start(frame_of(bits))) - end_of_last_pause(bits);
    CHECK(delay == Approx(1172).margin(1e-4));
  }
}

TEST_CASE("the last bit does not move the grid") {
  CHECK(first_answer_start(frame_of({1, 0, 1})) == first_answer_start(frame_of({1, 0, 0})));
}

TEST_CASE("an answer starts at the first grid instant when it is ready") {
  const Time first = first_answer_start(frame_of({1, 0, 1}));
  for (std::int64_t wait = -200'000'000; wait < 3'000'000'000; wait += 7'654'321) {
    const Time ready = first + Duration(wait);
    const Time start = answer_start(first, ready);
    const double slots = stride::to_seconds(start - first) * kCarrier / 128;
    REQUIRE(start >= ready);
    REQUIRE(std::round(slots) >= 0);
    REQUIRE(std::abs(slots - std::round(slots)) * 128 / kCarrier < 1e-12);
    if (wait > 0) REQUIRE(stride::to_seconds(start - ready) < 128 / kCarrier);
  }
  CHECK(answer_start(first, first) == first);
  CHECK(answer_start(first, first + Duration(1)) > first);
}
