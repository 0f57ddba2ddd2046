#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include <stride/time.h>

using stride::Duration;
using stride::duration_from_seconds;
using stride::kMaxSeconds;

namespace {

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
    if (seconds <= kMaxSeconds) check_nearest(seconds);
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
       {4503.599627370496, 9007.199254740993, 4611686.018427388, kMaxSeconds})
    check_nearest(seconds);
}

TEST_CASE("No time is infinite, not a number or beyond the largest one") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {std::nextafter(kMaxSeconds, kInfinity), kInfinity,
                               std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(duration_from_seconds(seconds), std::out_of_range);
    CHECK_THROWS_AS(duration_from_seconds(-seconds), std::out_of_range);
  }
}
