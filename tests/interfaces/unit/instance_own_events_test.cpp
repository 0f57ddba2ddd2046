// A unit of the kit that is used without Event Mode.
#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

InstanceChoices without_event_mode(bool early_return = false) {
  InstanceChoices choices;
  choices.event_mode = false;
  choices.early_return = early_return;
  return choices;
}

void check_whole(const UnitInstance::Step& last, double end) {
  CHECK_FALSE(last.event);
  CHECK_FALSE(last.early);
  CHECK_FALSE(last.terminate);
  CHECK(last.reached == end);
}

}  // namespace

TEST_CASE("events inside a step are handled at their instants") {
  const UnitLibrary library(unit_library("stepper"));
  const bool early_return = GENERATE(false, true);
  UnitInstance unit(library, without_event_mode(early_return));
  SECTION("those that were announced, with their iterations") {
    REQUIRE(unit.set_real("event_at", 0.25) == fmi3OK);
    REQUIRE(unit.initialize() == fmi3OK);
    CHECK(unit.integer("events") == 1);  // the one at the start
    REQUIRE(unit.step(0, 1) == fmi3OK);
    CHECK(unit.integer("events") == 3);
    CHECK(unit.integer("steps") == 2);
  }
  SECTION("those that the unit finds on its way") {
    REQUIRE(unit.set_real("early_at", 0.25) == fmi3OK);
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.step(0, 1) == fmi3OK);
    CHECK(unit.integer("events") == 2);
    CHECK(unit.integer("steps") == 2);
  }
  SECTION("those at its end") {
    REQUIRE(unit.set_real("event_at", 1) == fmi3OK);
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.step(0, 1) == fmi3OK);
    CHECK(unit.integer("events") == 3);
    CHECK(unit.integer("steps") == 1);
  }
  check_whole(unit.last, 1);
  CHECK(unit.real("position") == 2);
}

TEST_CASE("a unit with events makes of one long step what it makes of short ones with Event Mode") {
  const UnitLibrary library(unit_library("bouncing_ball"));
  UnitInstance ours(library, without_event_mode());
  REQUIRE(ours.initialize() == fmi3OK);
  REQUIRE(ours.step(0, 2) == fmi3OK);
  check_whole(ours.last, 2);

  InstanceChoices choices;
  choices.early_return = true;
  UnitInstance exact(library, choices);
  REQUIRE(exact.start_steps() == fmi3OK);
  for (double time = 0; time < 2; time = exact.last.reached) {
    REQUIRE(exact.step(time, 2 - time) == fmi3OK);
    if (!exact.last.event) continue;
    REQUIRE(library.EnterEventMode(exact.handle) == fmi3OK);
    do REQUIRE(exact.update() == fmi3OK);
    while (exact.iterate);
    REQUIRE(library.EnterStepMode(exact.handle) == fmi3OK);
  }
  CHECK(exact.real("h") > 0.1);
  CHECK(ours.real("h") == exact.real("h"));
  CHECK(ours.real("v") == exact.real("v"));
}

TEST_CASE("a discrete input that is set between steps is an event") {
  const UnitLibrary library(unit_library("clocks"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.integer("instants") == 1);
  REQUIRE(unit.set_boolean("start", true) == fmi3OK);
  REQUIRE(unit.step(0.1, 0.1) == fmi3OK);
  CHECK(unit.integer("instants") == 2);
}

TEST_CASE("a continuous input that is set between steps is not an event") {
  const UnitLibrary library(unit_library("minimal"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.set_real("time_constant", 1e-3) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.set_real("u", 3) == fmi3OK);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK(unit.real("y") == Approx(3));
}

TEST_CASE("messages that are not received are reported once, whatever is logged") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.set_real("tick_at", 0.5) == fmi3OK);
  REQUIRE(unit.set_real("event_at", 0.5) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  CHECK(unit.messages.empty());
  REQUIRE(unit.step(0, 1) == fmi3OK);
  REQUIRE(unit.messages.size() == 1);
  CHECK(unit.message_statuses[0] == fmi3Warning);
  CHECK(unit.message_categories[0] == "logStatusWarning");
  CHECK(unit.messages[0] ==
        "the importer does not use Event Mode: output clocks tick unheard, and what belongs to "
        "them is lost, the first time at 0.5 s ('clock')");
}

TEST_CASE("input clocks that never tick are reported once, at the start") {
  const UnitLibrary library(unit_library("clocks"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.messages.size() == 1);
  CHECK_THAT(unit.messages[0], Contains("input clocks never tick, and what belongs to them stays "
                                        "as it is ('constant', 'fixed', ") &&
                                   Contains("'triggered')"));
  CHECK(unit.set_clock("triggered", true) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("fmi3SetClock"));
}

TEST_CASE("nothing is reported of a unit without clocks, nor to an importer with Event Mode") {
  const UnitLibrary minimal(unit_library("minimal"));
  UnitInstance without_clocks(minimal, without_event_mode());
  REQUIRE(without_clocks.initialize() == fmi3OK);
  REQUIRE(without_clocks.step(0, 1) == fmi3OK);
  CHECK(without_clocks.messages.empty());

  const UnitLibrary clocks(unit_library("clocks"));
  UnitInstance with_event_mode(clocks);
  REQUIRE(with_event_mode.start_steps() == fmi3OK);
  REQUIRE(with_event_mode.step(0, 1) == fmi3OK);
  CHECK(with_event_mode.messages.empty());
}

TEST_CASE("a step that is rejected behind an event leaves the unit as it was before") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.set_real("event_at", 0.25) == fmi3OK);
  REQUIRE(unit.set_real("largest_step", 0.5) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  CHECK(unit.step(0, 1) == fmi3Discard);  // a quarter of it would have been good
  CHECK(unit.last.reached == 0);
  CHECK(unit.integer("steps") == 0);
  CHECK(unit.integer("events") == 1);
  CHECK(unit.real("position") == 0);
  REQUIRE(unit.step(0, 0.75) == fmi3OK);
  CHECK(unit.integer("events") == 3);
  CHECK(unit.real("position") == 1.5);
}

TEST_CASE("a unit that ends the simulation reports the time") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.set_real("event_at", 0.25) == fmi3OK);
  REQUIRE(unit.set_real("end_at", 0.25) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK(unit.last.terminate);
  CHECK_FALSE(unit.last.early);  // which the importer does not allow
  CHECK(unit.last.reached == 0.25);
  CHECK(unit.integer("events") == 3);
}

TEST_CASE("an early return without an event is one where the importer allows it") {
  const UnitLibrary library(unit_library("early"));
  const bool allowed = GENERATE(false, true);
  UnitInstance unit(library, without_event_mode(allowed));
  const fmi3ValueReference instants = unit.reference("instants");
  const double at[8] = {0.25, -1, -1, -1, -1, -1, -1, -1};
  REQUIRE(library.SetFloat64(unit.handle, &instants, 1, at, 8) == fmi3OK);
  REQUIRE(unit.set_boolean("wants_events", false) == fmi3OK);
  REQUIRE(unit.set_real("u", 1) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK(unit.last.early == allowed);
  CHECK(unit.last.reached == (allowed ? 0.25 : 1));
  CHECK(unit.real("y") == unit.last.reached);
  CHECK(unit.integer("events") == 0);
}

TEST_CASE("a restored state has its announced event") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, without_event_mode());
  REQUIRE(unit.set_real("event_at", 0.5) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  fmi3FMUState saved = nullptr;
  REQUIRE(library.GetFMUState(unit.handle, &saved) == fmi3OK);
  for (int pass = 0; pass < 2; ++pass) {
    REQUIRE(unit.step(0, 1) == fmi3OK);
    CHECK(unit.integer("events") == 3);
    REQUIRE(library.SetFMUState(unit.handle, saved) == fmi3OK);
    CHECK(unit.integer("events") == 1);
  }
  REQUIRE(library.FreeFMUState(unit.handle, &saved) == fmi3OK);
}
