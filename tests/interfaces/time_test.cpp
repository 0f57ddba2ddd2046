#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include <stride/time.h>

using stride::Duration;
using stride::duration_from_seconds;
using stride::kMaxSeconds;
using stride::Picoseconds;

namespace {

constexpr double kMostOf64Bits = 9.2e6;

/// Exactly: seconds are an integer times a power of two.
bool is_nearest(Duration duration, double seconds) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(seconds, &exponent), 53);
  const int shift = 53 - exponent;
  const Picoseconds exact = static_cast<Picoseconds>(mantissa) * Duration::period::den;
  const Picoseconds found = duration.count() * (Picoseconds{1} << shift);
  return 2 * (found > exact ? found - exact : exact - found) <= Picoseconds{1} << shift;
}

void check_nearest(double seconds) {
  CAPTURE(seconds);
  CHECK(duration_from_seconds(seconds).count() == std::llround(seconds * 1e12));
  CHECK(duration_from_seconds(-seconds).count() == std::llround(-seconds * 1e12));
}

}  // namespace

TEST_CASE("Seconds of any size become the nearest count of picoseconds") {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> mantissa(1, 2);
  for (int i = 0; i < 20'000; ++i) {
    const double seconds = std::ldexp(mantissa(random), i % 64 - 41);  // from 1e-12 s on
    if (seconds <= kMostOf64Bits) check_nearest(seconds);
  }
}

TEST_CASE("Halves of picoseconds are rounded away from zero, and what is next to them is not") {
  for (const double picoseconds : {0.0, 0.5, 1.5, 2.5, 1e6 + 0.5, 4503599627370495.5}) {
    const double seconds = picoseconds / 1e12;
    check_nearest(seconds);
    check_nearest(std::nextafter(seconds, 0));
    check_nearest(std::nextafter(seconds, 1e9));
  }
  CHECK(duration_from_seconds(0.5e-12) == Duration(1));
  CHECK(duration_from_seconds(-0.5e-12) == Duration(-1));
  CHECK(duration_from_seconds(std::nextafter(0.5e-12, 0)) == Duration(0));
}

TEST_CASE("Where doubles have no fraction of a picosecond, seconds become that count") {
  for (const double seconds :
       {4503.599627370496, 9007.199254740993, 4611686.018427388, kMostOf64Bits})
    check_nearest(seconds);
}

TEST_CASE("Seconds of years become the nearest count of picoseconds") {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> mantissa(1, 2);
  for (int i = 0; i < 2'000; ++i) {
    const double seconds = std::ldexp(mantissa(random), 24 + i % 25);
    CAPTURE(seconds);
    CHECK(is_nearest(duration_from_seconds(seconds), seconds));
    CHECK(duration_from_seconds(-seconds) == -duration_from_seconds(seconds));
    CHECK(stride::to_seconds(duration_from_seconds(seconds)) == seconds);
  }
  CHECK(duration_from_seconds(3155846401) == std::chrono::seconds(3155846401));
  CHECK(duration_from_seconds(kMaxSeconds) == std::chrono::seconds(1'000'000'000'000'000));
}

TEST_CASE("A duration is split into seconds and picoseconds of its sign") {
  const auto is = [](Duration duration, std::int64_t seconds, std::int64_t picoseconds) {
    const auto parts = stride::split(duration);
    return parts.seconds == seconds && parts.picoseconds == picoseconds;
  };
  using std::chrono::seconds;
  CHECK(is(seconds(3) + Duration(5), 3, 5));
  CHECK(is(-seconds(3) - Duration(5), -3, -5));
  CHECK(is(seconds(3155760000) + Duration(5), 3155760000, 5));
  CHECK(is(-seconds(3155760000) - Duration(5), -3155760000, -5));
}

TEST_CASE("The common divisor of durations is the longest that both are multiples of") {
  using namespace std::chrono_literals;
  CHECK(stride::common_divisor(6ms, 4ms) == 2ms);
  CHECK(stride::common_divisor(6ms, {}) == 6ms);
  CHECK(stride::common_divisor(876'001h, 90min) == 30min);
}

TEST_CASE("No time is infinite, not a number or beyond the largest one") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {std::nextafter(kMaxSeconds, kInfinity), kInfinity,
                               std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(duration_from_seconds(seconds), std::out_of_range);
    CHECK_THROWS_AS(duration_from_seconds(-seconds), std::out_of_range);
  }
}
