#include "master/engine/model/system/own_step.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

TEST_CASE("the hint at a unit's own step is there if it is another one") {
  UnitDescription unit;
  CHECK(own_step_hint("tank", unit, 1ms) == "");
  unit.default_step = 10ms;
  CHECK_THAT(
      own_step_hint("tank", unit, 1ms),
      Contains("(its DefaultExperiment), and takes steps of one size only") &&
          Contains("this one is of 0.001 s: use --step tank=0.01, or <stride:Step components="));
  CHECK(own_step_hint("tank", unit, 10ms) == "");
  unit.can_vary_step = true;
  CHECK_THAT(own_step_hint("tank", unit, 1ms),
             Contains("(its DefaultExperiment), and this one is"));
}

TEST_CASE("a unit with an internal step takes any multiple of it, unless its step cannot vary") {
  UnitDescription unit;
  unit.fixed_internal_step = 2ms;
  CHECK_THAT(own_step_hint("tank", unit, 4ms), Contains("its fixed internal step"));
  unit.can_vary_step = true;
  CHECK(own_step_hint("tank", unit, 4ms) == "");
  CHECK_THAT(own_step_hint("tank", unit, 3ms), Contains("use --step tank=0.002"));
}
