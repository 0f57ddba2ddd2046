// Inputs within a step, through the C entry points (FMI 3.0, 4.2.2).
#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

InstanceChoices with(std::vector<std::string> variables) {
  InstanceChoices choices;
  choices.intermediate = std::move(variables);
  return choices;
}

}  // namespace

TEST_CASE("the model description has which inputs may change within a step") {
  const std::string xml = UnitLibrary(unit_library("oscillator_mass")).describe();
  CHECK(attribute(xml, "<CoSimulation", "providesIntermediateUpdate") == "true");
  CHECK(attribute(xml, "name=\"x_other\"", "intermediateUpdate") == "true");
  CHECK(attribute(xml, "name=\"mass\"", "intermediateUpdate").empty());
  const std::string other = UnitLibrary(unit_library("types")).describe();
  CHECK(attribute(other, "<CoSimulation", "providesIntermediateUpdate").empty());
}

TEST_CASE("a unit requests its inputs within a step, and uses their values") {
  const UnitLibrary library(unit_library("oscillator_mass"));
  UnitInstance held(library);
  UnitInstance following(library, with({"x_other", "v_other"}));
  std::vector<double> times;
  following.on_intermediate_update = [&](double time) {
    times.push_back(time);
    CHECK(following.set_real("x_other", 100 * time) == fmi3OK);
  };
  for (UnitInstance* unit : {&held, &following}) {
    REQUIRE(unit->set_real("largest_step", 0.05) == fmi3OK);
    REQUIRE(unit->start_steps() == fmi3OK);
    REQUIRE(unit->step(0, 0.1) == fmi3OK);
    CHECK_FALSE(unit->last.early);
  }
  REQUIRE(times.size() == 7);
  const double expected[] = {0, 0.025, 0.05, 0.05, 0.075, 0.1, 0.1};
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(times[i] == Approx(expected[i]));
  CHECK(held.real("x_other") == 0);
  CHECK(following.real("x_other") == Approx(10));
  CHECK(following.real("x") > held.real("x") + 0.05);
}

TEST_CASE("the time of an intermediate update is the unit's own, however late") {
  const UnitLibrary library(unit_library("oscillator_mass"));
  UnitInstance unit(library, with({"x_other"}));
  REQUIRE(unit.start_steps(1000) == fmi3OK);
  bool inside = true;
  unit.on_intermediate_update = [&](double time) { inside &= time >= 1000 && time <= 1000.1; };
  REQUIRE(unit.step(1000, 1000.1 - 1000) == fmi3OK);
  CHECK(inside);
}

TEST_CASE("in Intermediate Update Mode the listed inputs can be set, and nothing else be done") {
  const UnitLibrary library(unit_library("oscillator_mass"));
  UnitInstance unit(library, with({"x_other"}));
  REQUIRE(unit.start_steps() == fmi3OK);
  int asked = 0;
  unit.on_intermediate_update = [&](double) {
    if (++asked > 1) return;
    CHECK(unit.set_real("x_other", 1) == fmi3OK);
    CHECK(unit.set_real("v_other", 1) == fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("'v_other' is not among the requiredIntermediate"));
    CHECK(unit.set_real("mass", 1) == fmi3Error);
    CHECK_THROWS_WITH(unit.real("x"), Contains("not allowed in Intermediate Update Mode"));
    CHECK(unit.step(0, 0.1) == fmi3Error);
    CHECK(unit.update() == fmi3Error);
    CHECK(unit.fmi.Reset(unit.handle) == fmi3Error);
    CHECK(unit.fmi.Terminate(unit.handle) == fmi3Error);
    fmi3FMUState state = nullptr;
    CHECK(unit.fmi.GetFMUState(unit.handle, &state) == fmi3Error);
  };
  CHECK(unit.step(0, 0.1) == fmi3OK);
  CHECK(asked > 1);
  CHECK(unit.real("v_other") == 0);
}

TEST_CASE("variables that are not intermediate cannot be required to be") {
  const UnitLibrary library(unit_library("oscillator_mass"));
  const UnitInstance unit(library, with({"x_other", "mass"}));
  CHECK(unit.handle == nullptr);
  CHECK_THAT(unit.last_message(), Contains("is not that of an intermediate variable"));
}

TEST_CASE("a callback that throws ends the step, not the process, and the unit can be reset") {
  const UnitLibrary library(unit_library("oscillator_mass"));
  UnitInstance unit(library, with({"x_other"}));
  REQUIRE(unit.start_steps() == fmi3OK);
  unit.on_intermediate_update = [](double) { throw std::runtime_error("the importer is C++"); };
  CHECK(unit.step(0, 0.1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("the importer is C++"));
  REQUIRE(unit.fmi.Reset(unit.handle) == fmi3OK);
  unit.on_intermediate_update = [](double) {};
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.step(0, 0.1) == fmi3OK);
}
