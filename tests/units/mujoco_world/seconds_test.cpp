#include "units/mujoco_world/seconds.h"

#include <cstdint>

#include <catch2/catch.hpp>

#include "tests/at.h"

using mujoco_world::seconds_text;
using mujoco_world::time_of;
using stride::tests::at;

TEST_CASE("times are read as they are written, and not otherwise") {
  for (const std::int64_t count : {0L, 1L, -1L, 30'000'000'000L, -250'000'000'000L, 1L << 62}) {
    const stride::Time time{stride::Duration(count)};
    CHECK(time_of(seconds_text(time)) == time);
  }
  for (const char* text : {"", "-", "-0", "1.", ".5", "0.50", "+1", "1 ", "1e3", "--1", "nan",
                           "0.0000000000001", "99999999999999999999"}) {
    CAPTURE(text);
    CHECK(time_of(text) == std::nullopt);
  }
}

TEST_CASE("times are written with all their digits") {
  CHECK(seconds_text(stride::Time(stride::Duration(1))) == "0.000000000001");
  CHECK(seconds_text(at(12)) == "12");
  CHECK(seconds_text(at(100.1)) == "100.1");
  CHECK(seconds_text(at(-0.25)) == "-0.25");
  CHECK(seconds_text(stride::Time{}) == "0");
}
