#include "master/system/scenario/default_step.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::scenario;
using namespace std::chrono_literals;

TEST_CASE("a run of a usual length has steps of 1 ms") {
  for (const Duration run : {Duration(100ms), Duration(1s), Duration(100s), Duration(199s)}) {
    CHECK(default_step(run) == 1ms);
  }
  CHECK(default_step(0s) == 1ms);
}

TEST_CASE("the steps of longer and of shorter runs follow their length") {
  CHECK(default_step(200s) == 2ms);
  CHECK(default_step(600s) == 5ms);
  CHECK(default_step(24h) == 500ms);
  CHECK(default_step(9'200'000s) == 50s);
  CHECK(default_step(99ms) == 500us);
  CHECK(default_step(1ms) == 10us);
  CHECK(default_step(300ns) == 2ns);
  CHECK(default_step(Duration(1)) == Duration(1));
}
