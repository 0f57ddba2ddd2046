#include "master/engine/model/time/grid.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

Interval fraction(std::uint64_t counter, std::uint64_t resolution) {
  return Interval::from_fraction(counter, resolution);
}

const std::vector<Interval> kSteps{1ms,
                                   Duration(1),
                                   fraction(1, 3),
                                   fraction(1, 7),
                                   fraction(1001, 30'000),
                                   fraction(1, 44'100),
                                   fraction(5, 2'000'000'000'000),
                                   fraction(7, 3'000'000'000'000)};

}  // namespace

TEST_CASE("each point of a grid is rounded once") {
  const Grid thirds(Time(1s), fraction(1, 3));
  CHECK(thirds.point(0) == Time(1s));
  CHECK(thirds.point(1) == Time(Duration(1'333'333'333'333)));
  CHECK(thirds.point(2) == Time(Duration(1'666'666'666'667)));
  CHECK(thirds.point(3) == Time(2s));
  CHECK(thirds.point(3'000'000) == Time(1'000'001s));
  CHECK(Grid(Time(), 10ms).point(7) == Time(70ms));
}

TEST_CASE("a point of a grid is found by its time") {
  for (const Interval& step : kSteps) {
    for (const Time start : {Time(), Time(3600s), Time(-7s)}) {
      const Grid grid(start, step);
      CAPTURE(to_text(step), start.time_since_epoch().count());
      for (const std::uint64_t index : {0ULL, 1ULL, 2ULL, 3ULL, 29ULL, 1'000'001ULL}) {
        const Time point = grid.point(index);
        CHECK(grid.index_at(point) == index);
        CHECK(grid.has(point));
        CHECK(grid.index_at(grid.point(index + 1) - Duration(1)) == index);
        CHECK(grid.last_point(grid.point(index + 1) - Duration(1)) == point);
      }
    }
  }
}

TEST_CASE("a walk meets the points of its grid") {
  for (const Interval& step : kSteps) {
    const Grid grid(Time(2s), step);
    CAPTURE(to_text(step));
    for (const std::uint64_t first : {0ULL, 5ULL, 999'999ULL}) {
      Grid::Walk walk(grid, grid.point(first));
      for (std::uint64_t k = first; k < first + 100; ++k, walk.advance()) {
        REQUIRE(walk.time() == grid.point(k));
        REQUIRE(walk.seconds() == grid.seconds(grid.point(k)));
      }
    }
  }
}

TEST_CASE("a walk over picoseconds that 64 bits can count is that of any grid") {
  const Grid grid(Time(-2s), Interval(100ms));
  REQUIRE(grid.is_narrow(100, grid.point(7)));
  CHECK_FALSE(Grid(Time(), fraction(1, 3)).is_narrow(1, Time()));
  CHECK(grid.is_narrow(92'233'740, grid.start()));
  CHECK_FALSE(grid.is_narrow(92'233'741, grid.start()));
  Grid::Walk walk(grid, grid.point(7));
  Grid::NarrowWalk whole(grid, grid.point(7));
  for (int k = 0; k < 100; ++k, walk.advance(), whole.advance()) {
    REQUIRE(whole.time() == walk.time());
    REQUIRE(whole.seconds() == walk.seconds());
  }
}

TEST_CASE("seconds are those of the point before it was rounded") {
  const Grid thirds(Time(), fraction(1, 3));
  for (std::uint64_t k = 0; k < 1000; ++k) {
    REQUIRE(thirds.seconds(thirds.point(k)) == static_cast<double>(k) / 3);
  }
  CHECK(thirds.seconds(thirds.point(2) - thirds.point(1)) == 1.0 / 3);
  CHECK(thirds.seconds(Time(Duration(333'333'333'334))) == 0.333333333334);
  CHECK(Grid(Time(10s), fraction(1, 3)).seconds(Time(Duration(10'333'333'333'333))) ==
        10 + 1.0 / 3);
}

TEST_CASE("regular steps may differ by what is negligible") {
  const Grid thirds(Time(), fraction(1, 3));
  CHECK(thirds.is_regular(Duration(333'333'333'333)));
  CHECK(thirds.is_regular(Duration(333'333'333'334)));
  CHECK_FALSE(thirds.is_regular(333ms));
  CHECK_FALSE(thirds.is_shorter(Duration(333'333'333'333)));
  CHECK(thirds.is_shorter(333ms));
  CHECK(thirds.ends_at(Time(2s)));
  CHECK_FALSE(thirds.ends_at(Time(2100ms)));
  const Grid rounded_down(Time(), Duration(333'333'333'333));
  const Grid rounded_up(Time(), Duration(333'333'333'334));
  CHECK(rounded_down.ends_at(Time(1s)));
  CHECK(rounded_up.ends_at(Time(1s)));
  CHECK(Grid(Time(), 1ns).negligible() == Duration());
  CHECK_FALSE(Grid(Time(), 1ns).ends_at(Time(Duration(1'000'001))));
}

TEST_CASE("points of years are exact, and found again") {
  constexpr auto kCentury = 3155760000s;
  const Grid days(Time(), Interval(24h));
  CHECK(days.point(36525) == Time(kCentury));
  CHECK(days.index_at(Time(kCentury) - Duration(1)) == 36524);
  const Grid thirds(Time(kCentury), fraction(1, 3));
  CHECK(thirds.point(2) == Time(kCentury + Duration(666'666'666'667)));
  CHECK(thirds.point(9467280000) == Time(2 * kCentury));
  for (const std::uint64_t k : {0ULL, 1ULL, 2ULL, 9467279999ULL, 9467280000ULL}) {
    CHECK(thirds.index_at(thirds.point(k)) == k);
    CHECK(thirds.has(thirds.point(k)));
    CHECK_FALSE(thirds.has(thirds.point(k) + Duration(1)));
  }
  Grid::Walk walk(thirds, thirds.point(9467279000));
  for (std::uint64_t k = 9467279000; k < 9467281000; ++k, walk.advance()) {
    REQUIRE(walk.time() == thirds.point(k));
  }
}

TEST_CASE("points beyond all times are later than any stop time") {
  const Time latest = stride::time_from_seconds(stride::kMaxSeconds);
  CHECK(Grid(Time(1s), 1s).point(UINT64_MAX) > latest);
  CHECK(Grid(Time(1s), fraction(1, 3)).point(UINT64_MAX) > latest);
  CHECK(Grid(Time(1s), Interval::from_seconds(INFINITY)).point(1) > latest);
}
