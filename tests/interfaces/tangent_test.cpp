#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include <stride/tangent.h>
#include <stride/time.h>

using namespace std::chrono_literals;
using stride::Duration;
using stride::tangent_holds_for;
using stride::Time;

TEST_CASE("a parabola leaves its tangent when the tolerance is used up") {
  CHECK(tangent_holds_for(2, 4) == Duration(1s));
  CHECK(tangent_holds_for(0, 4) == Duration(0));
  CHECK(tangent_holds_for(0.5e-6, 1) == Duration(1ms));
}

TEST_CASE("a sine stays within the tolerance for the computed time, and not for much longer") {
  const double tolerance = 1e-4;
  const double frequency = 3;  // sin(3 t) has a second derivative of at most 9
  const double holds = stride::to_seconds(tangent_holds_for(tolerance, frequency * frequency));
  double worst = 0;
  for (double start = 0; start < 2; start += 0.01) {
    const double slope = frequency * std::cos(frequency * start);
    const double tangent = std::sin(frequency * start) + slope * holds;
    worst = std::max(worst, std::abs(std::sin(frequency * (start + holds)) - tangent));
  }
  CHECK(worst <= tolerance);
  CHECK(worst > 0.99 * tolerance);
}

TEST_CASE("what has no curvature keeps to its tangent for ever") {
  CHECK(tangent_holds_for(1e-9, 0) == Duration::max());
  CHECK(tangent_holds_for(1e25, 1e-9) == Duration::max());
  CHECK(tangent_holds_for(1e300, 1e-300) == Duration::max());
  CHECK(tangent_holds_for(1e9, 0, 1e-9) == Duration::max());
}

TEST_CASE("a slope that is wrong uses up the tolerance, too") {
  CHECK(tangent_holds_for(1, 0, 0.5) == Duration(2s));
  CHECK(tangent_holds_for(1.5, 1, 1) == Duration(1s));
  CHECK(tangent_holds_for(0, 0, 1) == Duration(0));
}

TEST_CASE("a length of time is rounded down to a picosecond") {
  const double tolerance = 0.5 * 2.999e-12 * 2.999e-12;
  CHECK(tangent_holds_for(tolerance, 1) == Duration(2));
}

TEST_CASE("a tolerance or curvature that cannot be is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(tangent_holds_for(-1, 1), std::invalid_argument);
  CHECK_THROWS_AS(tangent_holds_for(1, -1), std::invalid_argument);
  CHECK_THROWS_AS(tangent_holds_for(nan, 1), std::invalid_argument);
  CHECK_THROWS_AS(tangent_holds_for(1, 1, -1), std::invalid_argument);
  CHECK_THROWS_AS(tangent_holds_for(1, 1, nan), std::invalid_argument);
  CHECK_THROWS_AS(tangent_holds_for(1, nan), std::invalid_argument);
}

TEST_CASE("later() does not pass the last instant") {
  CHECK(stride::later(Time(1s), 2s) == Time(3s));
  CHECK(stride::later(Time(-1s), Duration::max()) == Time(Duration::max() - Duration(1s)));
  CHECK(stride::later(Time(1s), Duration::max()) == Time::max());
  CHECK(stride::later(Time::max(), 1s) == Time::max());
  CHECK(stride::later(Time::max(), 0s) == Time::max());
}
