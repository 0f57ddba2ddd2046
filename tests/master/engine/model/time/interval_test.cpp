#include "master/engine/model/time/interval.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
constexpr Duration kLongest = std::chrono::seconds(1'000'000'000'000'000);
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The count of picoseconds of tick k from time 0 on.
Picoseconds tick(const Interval& interval, std::uint64_t k, const Interval& shift = {}) {
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

TEST_CASE("ticks of years are exact") {
  for (const double seconds : {2e7, 1e8, 3e8, 3155760000.0, 1e15}) {
    CAPTURE(seconds);
    CHECK(Interval::from_seconds(seconds) ==
          Interval::from_fraction(static_cast<std::uint64_t>(seconds), 1));
  }
  const Interval third = Interval::from_fraction(1, 3);
  CHECK(tick_time(Time(), {}, third, 9'467'280'001) ==
        Time(3155760000s + Duration(333'333'333'333)));
  const Interval odd = Interval::from_fraction(1, 7'000'000'000'001);
  CHECK(tick_time(Time(), odd, Interval::from_seconds(86400), 36525) == Time(3155760000s));
  constexpr std::uint64_t kFine = std::uint64_t{1} << 62;
  constexpr std::uint64_t kMany = std::uint64_t{1} << 40;  // 2^-22 s more than so many seconds
  CHECK(tick_time(Time(), {}, Interval::from_fraction(kFine + 1, kFine), kMany) ==
        Time(std::chrono::seconds(kMany) + Duration(238'419)));
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
  CHECK_FALSE(tick_time(Time(Duration(1)), {}, Interval::from_duration(kLongest), 1));
  CHECK(tick_time(Time(Duration(-1)), {}, Interval::from_duration(kLongest), 1));
  CHECK(tick_time(Time{}, {}, Interval::from_duration(kLongest), 1) == Time(kLongest));
}

TEST_CASE("below a picosecond") {
  CHECK(Interval::from_seconds(0.9e-12).is_below_picosecond());
  CHECK(Interval{}.is_below_picosecond());
  CHECK_FALSE(Interval::from_seconds(1e-12).is_below_picosecond());
}

TEST_CASE("a double of fifteen digits or more is the fraction that was rounded to them") {
  const auto fraction = &Interval::from_fraction;
  for (const std::uint64_t denominator : {3, 7, 30, 60, 1024, 44'100, 999'983, 14'318'180}) {
    CAPTURE(denominator);
    CHECK(Interval::from_seconds(1.0 / static_cast<double>(denominator)) ==
          fraction(1, denominator));
  }
  CHECK(Interval::from_seconds(1001.0 / 30'000) == fraction(1001, 30'000));
  CHECK(Interval::from_seconds(10.0 / 3) == fraction(10, 3));
  CHECK(Interval::from_seconds(0.1 + 0.2) == fraction(3, 10));
  CHECK(Interval::from_seconds(0.333333333333) == Interval(Duration(333'333'333'333)));
  CHECK(Interval::from_seconds(std::sqrt(0.5)).seconds() == std::sqrt(0.5));
  CHECK_FALSE(Interval::from_seconds(std::sqrt(0.5)).is_whole());
}

TEST_CASE("an interval is written as it is read") {
  for (const char* text :
       {"0.001", "1", "14.2", "0.3333333333333333", "1e-12", "0.0123456789012"}) {
    CAPTURE(text);
    CHECK(Interval::parse(to_text(Interval::parse(text))) == Interval::parse(text));
  }
  CHECK(to_text(Interval(1ms)) == "0.001");
  CHECK(to_text(Interval::from_fraction(1, 3)) == "0.3333333333333333");
  CHECK(Interval::parse(" 1e-3 ") == Interval(1ms));
  CHECK(Interval::parse("0.0000000012345") == Interval::from_fraction(12'345, 10'000'000'000'000));
  CHECK_THROWS_WITH(Interval::parse("-1"), Contains("is negative"));
  CHECK_THROWS_WITH(Interval::parse("1e16"), Contains("beyond 1e15 s"));
  CHECK_THROWS_WITH(Interval::parse("1/3"), Contains("is not a number"));
}

TEST_CASE("intervals are in the order of their lengths") {
  const Interval third = Interval::from_fraction(1, 3);
  CHECK(third > Interval(Duration(333'333'333'333)));
  CHECK(third < Interval(Duration(333'333'333'334)));
  CHECK(third < Interval::from_fraction(1000, 2999));
  CHECK(third <= Interval::from_fraction(2, 6));
  CHECK(third.rounded() == Duration(333'333'333'333));
  CHECK(Interval::from_seconds(kInfinity).rounded() == Duration::max());
}

TEST_CASE("multiples of intervals are exact") {
  const Interval third = Interval::from_fraction(1, 3);
  const Interval half = Interval::from_fraction(1, 2);
  CHECK(Interval(1s).is_multiple_of(third));
  CHECK_FALSE(half.is_multiple_of(third));
  CHECK_FALSE(Interval(Duration(333'333'333'333)).is_multiple_of(third));
  CHECK(common_multiple(third, half) == Interval(1s));
  CHECK(common_multiple(Interval(4ms), Interval(6ms)) == Interval(12ms));
  CHECK(common_multiple(third, Interval::from_fraction(2, 9)) == Interval::from_fraction(2, 3));
}

TEST_CASE("sums of intervals are exact, as far as they fit") {
  const Interval third = Interval::from_fraction(1, 3);
  CHECK(sum(third, Interval::from_fraction(1, 6), 4) == Interval(1s));
  CHECK(sum({}, third, 3) == Interval(1s));
  CHECK(sum(third, {}, 1000) == third);
  CHECK(sum(Interval::from_fraction(1, 30), Interval::from_fraction(1, 30), 299) == Interval(10s));
  const Interval fine = Interval::from_fraction(1, (std::uint64_t{1} << 61) - 1);
  CHECK(sum(fine, fine, 1) == Interval::from_fraction(2, (std::uint64_t{1} << 61) - 1));
  CHECK_FALSE(sum(fine, third, 1));
}
