#include "units/player/curve.h"

#include <catch2/catch.hpp>

using player::Curve;
using stride::time_from_seconds;

namespace {

/// Up from 1 to 3 within two seconds, down to 0 at once, and there to 4 s.
Curve saw_tooth() {
  Curve curve;
  curve.add(time_from_seconds(1), 1);
  curve.add(time_from_seconds(3), 3);
  curve.add(time_from_seconds(3), 0);
  curve.add(time_from_seconds(4), 0);
  return curve;
}

}  // namespace

TEST_CASE("a curve is straight between its points, and held outside of them") {
  const Curve curve = saw_tooth();
  CHECK(curve.at(time_from_seconds(0)).value == 1);
  CHECK(curve.at(time_from_seconds(0)).slope == 0);
  CHECK(curve.at(time_from_seconds(1)).value == 1);
  CHECK(curve.at(time_from_seconds(1)).slope == 1);
  CHECK(curve.at(time_from_seconds(2.5)).value == 2.5);
  CHECK(curve.at(time_from_seconds(9)).value == 0);
  CHECK(curve.at(time_from_seconds(9)).slope == 0);
}

TEST_CASE("at a jump there is a value before it, and one behind") {
  const Curve curve = saw_tooth();
  CHECK(curve.before(time_from_seconds(3)) == 3);
  CHECK(curve.at(time_from_seconds(3)).value == 0);
  CHECK(curve.before(time_from_seconds(2)) == 2);
}

TEST_CASE("the next point is later, and there is none behind the last one") {
  const Curve curve = saw_tooth();
  CHECK(curve.next(time_from_seconds(0)) == time_from_seconds(1));
  CHECK(curve.next(time_from_seconds(1)) == time_from_seconds(3));
  CHECK(curve.next(time_from_seconds(3)) == time_from_seconds(4));
  CHECK(!curve.next(time_from_seconds(4)));
  CHECK(curve.magnitude() == 3);
}

TEST_CASE("two points of one time and value are no jump") {
  Curve curve;
  curve.add(time_from_seconds(1), 2);
  CHECK(!curve.ends_with_jump());
  curve.add(time_from_seconds(1), 2);
  CHECK(!curve.ends_with_jump());
  curve.add(time_from_seconds(1), 3);
  CHECK(curve.ends_with_jump());
}
