#include "master/base/text/suggest.h"

#include <vector>

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("the nearest name is suggested, and only if it is near") {
  const std::vector<std::string> names = {"sensor", "channel", "world"};
  CHECK(nearest("sensr", names) == "sensor");
  CHECK(nearest("chanel", names) == "channel");
  CHECK(nearest("environment", names).empty());
  CHECK(suggestion("wrld", names) == "did you mean 'world'?");
  CHECK(suggestion("environment", names) == "known are: sensor, channel, world");
  CHECK(suggestion("x", {}) == "there are none");
}

TEST_CASE("the nearest of several near names is suggested, and the first of the equally near") {
  const std::vector<std::string> names = {"speed_max", "speed_min", "speeds", "speed2", "steed"};
  CHECK(nearest("speed", names) == "speeds");
  CHECK(nearest("speed_mix", names) == "speed_max");
  CHECK(nearest("seed2", names) == "speed2");
  CHECK(nearest("speed_min", names) == "speed_min");
}

TEST_CASE("what names have in common before a dot does not make the rest alike") {
  const std::vector<std::string> names{"types.time", "types.colour", "types.colour.echo"};
  CHECK(nearest("types.nope", names).empty());
  CHECK(nearest("types.color", names) == "types.colour");
  CHECK(nearest("types.colour.ecko", names) == "types.colour.echo");
  CHECK(nearest("tipes.time", names) == "types.time");
}

TEST_CASE("a long list is shortened") {
  const std::vector<std::string> names(20, "abcdefgh");
  CHECK(suggestion("zzzzzzzzzzzzzzzzzzz", names).find("…") != std::string::npos);
}

TEST_CASE("a name that differs by case only comes before all others") {
  const std::vector<std::string> names{"u", "y", "OUTPUT"};
  CHECK(nearest("Y", names) == "y");
  CHECK(nearest("output", names) == "OUTPUT");
}
