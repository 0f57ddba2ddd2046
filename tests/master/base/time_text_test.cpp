#include "master/base/time_text.h"

#include <stdexcept>

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using stride::Duration;
using stride::Time;
using stride::core::parse_seconds;
using stride::core::to_text;

TEST_CASE("A decimal text becomes the exact count of picoseconds") {
  const auto [text, ticks] = GENERATE(table<const char*, std::int64_t>({
      {"0.001", 1'000'000'000},
      {"14.2", 14'200'000'000'000},
      {"30", 30'000'000'000'000},
      {" 30\n", 30'000'000'000'000},
      {"+1.", 1'000'000'000'000},
      {".5", 500'000'000'000},
      {"0", 0},
      {"-0.0", 0},
      {"0.000000000001", 1},
      {"1e-12", 1},
      {"1E+3", 1'000'000'000'000'000},
      {"123.456e-3", 123'456'000'000},
      {"0000.1000", 100'000'000'000},
      {"9200000", 9'200'000'000'000'000'000},
      {"4611686.018427387905", 4'611'686'018'427'387'905},  // no double holds this
  }));
  CAPTURE(text);
  CHECK(parse_seconds(text) == Duration(ticks));
}

TEST_CASE("More than twelve decimals are rounded to the picosecond") {
  const auto [text, ticks] = GENERATE(table<const char*, std::int64_t>({
      {"0.0000000000014", 1},
      {"0.0000000000015", 2},
      {"0.9999999999999", 1'000'000'000'000},
      {"5e-13", 1},
      {"0e-99", 0},
  }));
  CAPTURE(text);
  CHECK(parse_seconds(text) == Duration(ticks));
}

TEST_CASE("What is not a time is refused, and the text says what was expected") {
  const auto [text, reason] = GENERATE(table<const char*, const char*>({
      {"", "is not a number"},
      {" ", "is not a number"},
      {".", "is not a number"},
      {"-", "is not a number"},
      {"1 s", "is not a number; expected a number of seconds such as 0.001 or 1e-3; write 1"},
      {"2ms", "; write 0.002"},
      {"1.5 h", "; write 5400"},
      {"1 m", "such as 0.001 or 1e-3"},
      {"1,5", "; write 1.5"},
      {"0x10", "is not a number"},
      {"1e", "is not a number"},
      {"1e+", "is not a number"},
      {"nan", "is not a number"},
      {"INF", "is not a number"},
      {"1.2.3", "is not a number"},
      {"-1", "is negative"},
      {"-1e-12", "is negative"},
      {"1000000000000000.000000000001", "is beyond 1e15 s"},
      {"1e16", "is beyond 1e15 s"},
      {"1e99999999999999999999", "is beyond 1e15 s"},
      {"4.9e-13", "is not 0 s and less than 1 ps"},
      {"9e-14", "less than 1 ps, the resolution of times"},
      {"1e-999999999999999999999", "less than 1 ps"},
  }));
  CAPTURE(text);
  CHECK_THROWS_AS(parse_seconds(text), std::invalid_argument);
  CHECK_THROWS_WITH(parse_seconds(text), Catch::Contains(reason) &&
                                             Catch::Contains("a number of seconds such as 0.001"));
}

TEST_CASE("an instant may be before 0 s") {
  CHECK(parse_time("-0.5") == Time(-std::chrono::milliseconds(500)));
  CHECK(parse_time(" -1e-12 ") == Time(Duration(-1)));
  CHECK(parse_time("-0") == Time());
  CHECK(parse_time("14.2") == Time(std::chrono::milliseconds(14'200)));
  CHECK_THROWS_WITH(parse_time("-1e16"), Catch::Contains("'-1e16' is beyond 1e15 s"));
  CHECK_THROWS_WITH(parse_time("--1"), Catch::Contains("is not a number"));
}

TEST_CASE("what is no time is quoted whole, also where it has a NUL") {
  CHECK_THROWS_WITH(parse_seconds(std::string_view("1\0x", 3)),
                    Catch::Contains("'1\\x00x' is not a number"));
}

TEST_CASE("the time of a computation is printed to the millisecond") {
  CHECK(stride::core::wall_seconds(std::chrono::nanoseconds(1'234'567'890)) == "1.235");
  CHECK(stride::core::wall_seconds({}) == "0.000");
}

TEST_CASE("a time's text is exact") {
  CHECK(to_text(Time{}) == "0");
  CHECK(to_text(Time(Duration(1))) == "0.000000000001");
  CHECK(to_text(stride::time_from_seconds(14.2)) == "14.2");
  CHECK(to_text(stride::time_from_seconds(30)) == "30");
  CHECK(to_text(Time(Duration(-1'500'000'000'000))) == "-1.5");
  CHECK(to_text(Duration(-1'500'000'000'000)) == "-1.5");
  CHECK(to_text(Time(Duration::min())) == "-170141183460469231731687303.715884105728");
}
