#include <cstdint>

#include <catch2/catch.hpp>

#include <stride/time_text.h>

using stride::decimal_seconds;
using stride::Duration;
using stride::Time;
using stride::time_of_decimal;

TEST_CASE("times are read as they are written") {
  for (const std::int64_t count : {0L, 1L, -1L, 30'000'000'000L, -250'000'000'000L, 1L << 62}) {
    for (const std::int64_t years : {0, 1, -100, 30'000'000}) {
      const Time time(Duration(count) + std::chrono::seconds(31'557'600 * years));
      CAPTURE(decimal_seconds(time));
      CHECK(time_of_decimal(decimal_seconds(time)) == time);
    }
  }
  CHECK(time_of_decimal("0.50") == Time(std::chrono::milliseconds(500)));
}

TEST_CASE("decimals of other units than seconds are exact, too") {
  CHECK(time_of_decimal("0.001", std::chrono::hours(1)) == Time(std::chrono::milliseconds(3600)));
  CHECK(time_of_decimal("-1.5", std::chrono::nanoseconds(1)) == Time(Duration(-1500)));
  CHECK(time_of_decimal("0.0005", std::chrono::nanoseconds(1)) == std::nullopt);
  CHECK(time_of_decimal("1700000000.1") ==
        Time(std::chrono::seconds(1'700'000'000) + std::chrono::milliseconds(100)));
}

TEST_CASE("what is no decimal of a time is no time") {
  for (const char* text :
       {"", "-", ".", "1.", ".5", "+1", "1 ", "1e3", "--1", "nan", "1.2.3", "0.0000000000001",
        "1000000000000000.000000000001", "99999999999999999999"}) {
    CAPTURE(text);
    CHECK(time_of_decimal(text) == std::nullopt);
  }
}

TEST_CASE("times are written with all their digits") {
  using namespace std::chrono_literals;
  CHECK(decimal_seconds(Duration(1)) == "0.000000000001");
  CHECK(decimal_seconds(12s) == "12");
  CHECK(decimal_seconds(100100ms) == "100.1");
  CHECK(decimal_seconds(-250ms) == "-0.25");
  CHECK(decimal_seconds(Duration{}) == "0");
  CHECK(decimal_seconds(3155760000s + Duration(1)) == "3155760000.000000000001");
}
