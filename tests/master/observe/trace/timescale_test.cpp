#include "master/observe/trace/timescale.h"

#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::trace;

TEST_CASE("A time scale is 1, 10 or 100 of a unit, with or without a blank") {
  const std::pair<const char*, int> expected[] = {
      {"1 fs", -15}, {"10 fs", -14}, {"100fs", -13}, {"1 ps", -12}, {"10ps", -11}, {"100 ps", -10},
      {"1ns", -9},   {"100 us", -4}, {"1 ms", -3},   {"1 s", 0},    {"10 s", 1},   {"100s", 2}};
  for (const auto& [text, exponent] : expected) {
    INFO(text);
    CHECK(Timescale::parse(text).exponent == exponent);
    CHECK(Timescale::parse(Timescale{exponent}.text()) == Timescale{exponent});
  }
  CHECK(Timescale::parse("1\n\tns").text() == "1 ns");
}

TEST_CASE("Anything else is not a time scale") {
  for (const char* text : {"", "1", "ps", "2 ps", "1000 ps", "1 as", "1 Ps", "-1 ps", "1.0 ps"}) {
    INFO(text);
    CHECK_THROWS_AS(Timescale::parse(text), std::invalid_argument);
  }
  CHECK_THROWS_WITH(Timescale::parse(std::string("1\0s", 3)),
                    Catch::Contains("'1\\x00s' is not a time scale"));
}

TEST_CASE("Ticks are exact decimals of seconds") {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  CHECK(Timescale{-12}.seconds(0) == "0");
  CHECK(Timescale{-12}.seconds(1) == "0.000000000001");
  CHECK(Timescale{-12}.seconds(14'200'000'000'000) == "14.2");
  CHECK(Timescale{-12}.seconds(kMost) == "9223372.036854775807");
  CHECK(Timescale{-15}.seconds(kMost) == "9223.372036854775807");
  CHECK(Timescale{-3}.seconds(30'000) == "30");
  CHECK(Timescale{0}.seconds(70) == "70");
  CHECK(Timescale{2}.seconds(7) == "700");
}

TEST_CASE("A duration has so many whole ticks") {
  CHECK(Timescale{-12}.ticks_in(Duration(1999)) == 1999);
  CHECK(Timescale{-9}.ticks_in(Duration(1999)) == 1);
  CHECK(Timescale{-9}.ticks_in(Duration(999)) == 0);
  CHECK(Timescale{-14}.ticks_in(Duration(7)) == 700);
  CHECK(Timescale{2}.ticks_in(Duration(250'000'000'000'000)) == 2);
  CHECK(Timescale{-15}.ticks_in(Duration(9'200'000'000'000'000'000)) ==
        std::numeric_limits<std::int64_t>::max());
}
