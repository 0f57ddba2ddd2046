#include <cmath>

#include <catch2/catch.hpp>

#include <stride/nfc/frame_delay.h>

using nfc::answer_start;
using stride::Duration;
using stride::Time;

namespace {

constexpr double kCarrier = 13.56e6;
const Time kEnd(Duration(1'234'567'890'123));

}  // namespace

TEST_CASE("the shortest frame delay is 1236 carrier periods") {
  const Duration shortest(static_cast<std::int64_t>(std::llround(1236 / kCarrier * 1e12)));
  CHECK(answer_start(kEnd, kEnd) == kEnd + shortest);
  CHECK(answer_start(kEnd, kEnd + shortest) == kEnd + shortest);
  CHECK(answer_start(kEnd, kEnd + shortest + Duration(1)) > kEnd + shortest);
}

TEST_CASE("an answer starts at the first grid instant when it is ready") {
  for (std::int64_t wait = 0; wait < 3'000'000'000; wait += 7'654'321) {
    const Time ready = kEnd + Duration(wait);
    const Time start = answer_start(kEnd, ready);
    const double slots = (stride::to_seconds(start - kEnd) * kCarrier - 84) / 128;
    REQUIRE(start >= ready);
    REQUIRE(std::round(slots) >= 9);
    REQUIRE(std::abs(slots - std::round(slots)) * 128 / kCarrier < 1e-12);
    if (wait > 95'000'000) {
      REQUIRE(stride::to_seconds(start - ready) < 128 / kCarrier);
    }
  }
}
