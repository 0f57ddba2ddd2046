#include "units/reader/motion.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/units/reader/programs.h"

using reader::minimum_jerk;
using reader::position;
using reader::Waypoint;

namespace {

using reader::tests::at;

const std::vector<Waypoint> kPath = {
    {at(1.0), {0.0, 1.0}}, {at(3.0), {2.0, 1.0}}, {at(4.0), {-1.0, 0.5}}};

double velocity(std::size_t axis, double time, double h = 1e-4) {
  return (position(kPath, axis, at(time + h)) - position(kPath, axis, at(time - h))) / (2 * h);
}

double acceleration(std::size_t axis, double time, double h = 1e-4) {
  return (position(kPath, axis, at(time + h)) - 2 * position(kPath, axis, at(time)) +
          position(kPath, axis, at(time - h))) /
         (h * h);
}

}  // namespace

TEST_CASE("The path of minimum jerk goes from 0 to 1 and is symmetric about its middle") {
  CHECK(minimum_jerk(0.0) == 0.0);
  CHECK(minimum_jerk(0.5) == Approx(0.5));
  CHECK(minimum_jerk(1.0) == Approx(1.0).epsilon(1e-15));
  for (const double s : {0.1, 0.2, 0.37}) CHECK(minimum_jerk(s) + minimum_jerk(1 - s) == Approx(1));
  CHECK(minimum_jerk(-0.5) == 0.0);
  CHECK(minimum_jerk(1.5) == minimum_jerk(1.0));
}

TEST_CASE("Its greatest speed is 15/8 of the mean speed") {
  const double h = 1e-5;
  CHECK((minimum_jerk(0.5 + h) - minimum_jerk(0.5 - h)) / (2 * h) == Approx(1.875).epsilon(1e-6));
}

TEST_CASE("An axis passes its waypoints at their times and does not move before and after") {
  CHECK(position(kPath, 0, at(0.0)) == 0.0);
  CHECK(position(kPath, 0, at(1.0)) == 0.0);
  CHECK(position(kPath, 0, at(2.0)) == Approx(1.0));
  CHECK(position(kPath, 0, at(3.0)) == 2.0);
  CHECK(position(kPath, 0, at(4.0)) == -1.0);
  CHECK(position(kPath, 0, at(100.0)) == -1.0);
  CHECK(position(kPath, 1, at(2.0)) == 1.0);
  CHECK(position(kPath, 1, at(3.5)) == Approx(0.75));
}

TEST_CASE("Velocity and acceleration are zero in each waypoint") {
  for (const double time : {1.0, 3.0, 4.0}) {
    CHECK(velocity(0, time) == Approx(0.0).margin(1e-5));
    CHECK(acceleration(0, time) == Approx(0.0).margin(0.05));
  }
  CHECK(velocity(0, 2.0) == Approx(1.875).epsilon(1e-4));  // the way is 2 in 2 s
  CHECK(std::abs(acceleration(0, 1.5)) > 1.0);             // not zero in between
}

TEST_CASE("One waypoint is a pose that is held") {
  const std::vector<Waypoint> held = {{at(5.0), {0.25}}};
  for (const double time : {0.0, 5.0, 9.0}) CHECK(position(held, 0, at(time)) == 0.25);
}
