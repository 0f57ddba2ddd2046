#include "master/engine/port/unit.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace std::chrono_literals;
using core::StepInterval;

TEST_CASE("a regular step has the same size everywhere, as its duration is converted") {
  const auto [step, seconds] = GENERATE(table<Duration, double>({{100ms, 0.1}, {10ms, 0.01}}));
  for (Time from{}; from < Time(1000s); from += step) {
    const StepInterval interval(from, from + step);
    REQUIRE(interval.size_seconds == seconds);
    REQUIRE(interval.begin_seconds + interval.size_seconds == Approx(interval.end_seconds));
  }
}

TEST_CASE("where doubles hardly distinguish the ends of a step, its size is their difference") {
  const Time late(9'000'000s);  // where a double is 1.9 ns from the next
  const StepInterval same(late, late + Duration(100));
  CHECK(same.size_seconds == 0);
  const StepInterval coarse(late, late + Duration(2000));
  CHECK(coarse.size_seconds == coarse.end_seconds - coarse.begin_seconds);
  CHECK(coarse.begin_seconds + coarse.size_seconds == coarse.end_seconds);
}
