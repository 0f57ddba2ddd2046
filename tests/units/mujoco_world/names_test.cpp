#include "units/mujoco_world/names.h"

#include <catch2/catch.hpp>

using mujoco_world::name_part;

TEST_CASE("a name that is not an identifier is quoted", "[mujoco_world]") {
  CHECK(name_part("elbow_1") == "elbow_1");
  CHECK(name_part("_") == "_");
  CHECK(name_part("left arm") == "'left arm'");
  CHECK(name_part("ur5e/elbow.joint") == "'ur5e/elbow.joint'");
  CHECK(name_part("1st") == "'1st'");
  CHECK(name_part("it's") == R"('it\'s')");
  CHECK(name_part(R"(a\b)") == R"('a\\b')");
  CHECK(name_part(R"(12" arm)") == R"('12\" arm')");
}

TEST_CASE("a name that FMI cannot have is an error", "[mujoco_world]") {
  for (const char* name : {"Gelenk_\xC3\xBC", "two\nlines", "a`b"}) {
    CHECK_THROWS_WITH(name_part(name), Catch::Contains(name) && Catch::Contains("printable ASCII"));
  }
}
