#include "master/base/text/glob.h"

#include <catch2/catch.hpp>

using stride::core::is_glob;
using stride::core::matches_glob;

TEST_CASE("A glob matches the whole name, and its star crosses dots") {
  CHECK(matches_glob("sensor.*", "sensor.adc.value"));
  CHECK(matches_glob("*", "sensor.led"));
  CHECK(matches_glob("*.frames.*", "sensor.frames.sent"));
  CHECK(matches_glob("sensor.led", "sensor.led"));
  CHECK_FALSE(matches_glob("sensor", "sensor.led"));
  CHECK_FALSE(matches_glob("sensor.*", "sensor"));
  CHECK_FALSE(matches_glob("led", "sensor.led"));
  CHECK_FALSE(matches_glob("", "a"));
}

TEST_CASE("Question marks and sets match one character") {
  CHECK(matches_glob("joint?", "joint1"));
  CHECK_FALSE(matches_glob("joint?", "joint12"));
  CHECK(matches_glob("axis.[xy]", "axis.y"));
  CHECK_FALSE(matches_glob("axis.[xy]", "axis.z"));
  CHECK(matches_glob("axis.[!xy]", "axis.z"));
  CHECK(matches_glob("a[1-3]", "a2"));
  CHECK(matches_glob("a\\*", "a*"));
  CHECK_FALSE(matches_glob("a\\*", "ab"));
  CHECK(matches_glob("a[", "a["));
}

TEST_CASE("A name is not a glob") {
  CHECK_FALSE(is_glob("sensor.led"));
  CHECK(is_glob("sensor.*"));
  CHECK(is_glob("a[1]"));
  CHECK(is_glob("?"));
}
