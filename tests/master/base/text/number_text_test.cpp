#include "master/base/text/number_text.h"

#include <stdexcept>

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("numbers of at least 0, and above it") {
  CHECK(parse_at_least_zero("0") == 0);
  CHECK(parse_at_least_zero("1.5e-3") == 1.5e-3);
  CHECK(parse_above_zero("1.5e-3") == 1.5e-3);
  CHECK_THROWS_WITH(parse_above_zero("0"), "'0' is not a number above 0");
  for (const char* text : {"-1", "inf", "nan", "1 m", "x", ""}) {
    CHECK_THROWS_AS(parse_at_least_zero(text), std::invalid_argument);
    CHECK_THROWS_AS(parse_above_zero(text), std::invalid_argument);
  }
}
