#include "units/channel/decibels.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace channel;

TEST_CASE("Decibels stay finite") {
  CHECK(decibels(100.0) == Approx(20.0));
  CHECK(decibels(0.5) == Approx(-3.0103));
  CHECK(decibels(0.0) == -200.0);
  CHECK(decibels(std::numeric_limits<double>::infinity()) == 200.0);
}

TEST_CASE("What is in decibels is a ratio again") {
  CHECK(from_decibels(20.0) == Approx(100.0));
  CHECK(from_decibels(decibels(0.037)) == Approx(0.037));
}
