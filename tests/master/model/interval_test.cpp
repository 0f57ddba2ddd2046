#include "master/model/interval.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The count of picoseconds of tick k from time 0 on.
std::int64_t tick(const Interval& interval, std::uint64_t k, const Interval& shift = {}) {
  return tick_time(Time{}, shift, interval, k).value().time_since_epoch().count();
}

}  // namespace

TEST_CASE("a fraction is exact, and rounded once") {
  const Interval third = Interval::from_fraction(1, 3);
  CHECK(tick(third, 1) == 333'333'333'333);
  CHECK(tick(third, 2) == 666'666'666'667);
  CHECK(tick(third, 3) == 1'000'000'000'000);
  CHECK(tick(third, 24'000'000) == 8'000'000'000'000'000'000);
  CHECK(Interval::from_fraction(2, 6) == third);
  CHECK(tick(Interval::from_fraction(1, 44'100), 44'100 * 86'400ULL) == 86'400'000'000'000'000);
}

TEST_CASE("shift and interval are added before they are rounded") {
  // 1/3 and 1/6 of a picosecond
  const Interval third = Interval::from_fraction(1, 3'000'000'000'000);
  const Interval sixth = Interval::from_fraction(1, 6'000'000'000'000);
  CHECK(tick(sixth, 0, third) == 0);
  CHECK(tick(sixth, 1, third) == 1);
  CHECK(tick(sixth, 6, third) == 1);
  CHECK(tick(sixth, 7, third) == 2);
  CHECK(tick(sixth, 2, third) == 1);  // two thirds
  CHECK(tick(third, 2) == 1);
  CHECK(tick(third, 1) == 0);
  const Interval odd = Interval::from_fraction(1, 7'000'000'000'001);
  CHECK(tick(odd, 7'000'000'000'001, third) == 1'000'000'000'000);
}

TEST_CASE("a double is the decimal that a person would write for it") {
  CHECK(Interval::from_seconds(0.1) == Interval::from_fraction(1, 10));
  CHECK(Interval::from_seconds(1e-12) == Interval::from_fraction(1, 1'000'000'000'000));
  CHECK(Interval::from_seconds(2e6) == Interval::from_fraction(2'000'000, 1));
  CHECK(Interval::from_seconds(0.0123) == Interval::from_fraction(123, 10'000));
  CHECK(Interval::from_seconds(0).is_zero());
  // 0.1 itself is 5.6e-18 more, which ten million ticks would show
  CHECK(tick(Interval::from_seconds(0.1), 10'000'000) == 1'000'000'000'000'000'000);
  CHECK(Interval::from_seconds(std::sqrt(2.0) * 1e-3).seconds() == Approx(std::sqrt(2.0) * 1e-3));
  CHECK(tick(Interval::from_seconds(1e-30), 1) == 0);
}

TEST_CASE("what is not a length of time is refused") {
  CHECK_THROWS_WITH(Interval::from_seconds(-1e-3), Contains("negative"));
  CHECK_THROWS_WITH(Interval::from_seconds(std::nan("")), Contains("not a number"));
  CHECK_THROWS_WITH(Interval::from_fraction(1, 0), Contains("resolution is 0"));
  constexpr std::uint64_t kPrime = kMax - 58;
  CHECK_THROWS_WITH(Interval::from_fraction(1, kPrime), Contains("finer than any clock's"));
  CHECK_THROWS_AS(Interval::from_duration(Duration(-1)), std::invalid_argument);
}

TEST_CASE("what is later than any time is not a tick") {
  CHECK_FALSE(tick_time(Time{}, {}, Interval::from_seconds(kInfinity), 1));
  CHECK_FALSE(tick_time(Time{}, Interval::from_seconds(1e300), {}, 0));
  CHECK_FALSE(tick_time(Time{}, {}, Interval::from_fraction(kMax, 1), kMax));
  CHECK_FALSE(tick_time(Time(Duration(1)), {}, Interval::from_duration(Duration::max()), 1));
  CHECK(tick_time(Time(Duration(-1)), {}, Interval::from_duration(Duration::max()), 1));
  CHECK(tick_time(Time{}, {}, Interval::from_duration(Duration::max()), 1) == Time::max());
}

TEST_CASE("below a picosecond") {
  CHECK(Interval::from_seconds(0.9e-12).is_below_picosecond());
  CHECK(Interval{}.is_below_picosecond());
  CHECK_FALSE(Interval::from_seconds(1e-12).is_below_picosecond());
}
