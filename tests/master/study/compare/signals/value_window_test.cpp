#include "master/study/compare/signals/value_window.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using stride::compare::ValueWindow;

namespace {

ValueWindow window_of(std::initializer_list<double> values) {
  ValueWindow window;
  for (const double value : values) window.add(value);
  return window;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("of single values the nearest one is found") {
  const ValueWindow window = window_of({1, 4, 4, -2});
  CHECK(window.nearest(0, false) == 1);
  CHECK(window.nearest(2.4, false) == 1);
  CHECK(window.nearest(2.6, false) == 4);
  CHECK(window.nearest(9, false) == 4);
  CHECK(window.nearest(-9, false) == -2);
}

TEST_CASE("of connected values all between the least and the greatest are there") {
  const ValueWindow window = window_of({1, 4});
  CHECK(window.nearest(2.5, true) == 2.5);
  CHECK(window.nearest(0, true) == 1);
  CHECK(window.nearest(5, true) == 4);
}

TEST_CASE("no straight line leads to infinity") {
  CHECK(window_of({1, kInfinite}).nearest(2.5, true) == 1);
  CHECK(window_of({1, kInfinite}).nearest(kInfinite, true) == kInfinite);
}

TEST_CASE("each value is taken out once") {
  ValueWindow window = window_of({1, 1, 3});
  window.remove(1);
  CHECK(window.nearest(0, false) == 1);
  window.remove(1);
  CHECK(window.nearest(0, false) == 3);
}

TEST_CASE("NaN is near to NaN alone") {
  ValueWindow window = window_of({kNaN, 1});
  CHECK(std::isnan(window.nearest(kNaN, true)));
  CHECK(window.nearest(5, true) == 1);
  window.remove(kNaN);
  CHECK(window.nearest(kNaN, true) == 1);
  CHECK(std::isnan(window_of({kNaN}).nearest(5, false)));
}
