// The functions of <stride/idle.h>, through the C entry points.
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Of the parameter "promise".
constexpr std::int64_t kRejects = 3, kPromisesEver = 6;

InstanceChoices choices(bool event_mode = true) {
  InstanceChoices choices;
  choices.early_return = true;
  choices.event_mode = event_mode;
  return choices;
}

/// An idler in Step Mode at 0 s, which may skip for max_skip seconds.
struct Idler {
  explicit Idler(double max_skip = kEver, double rate = 0, double period = 0,
                 bool announces = false, std::int64_t promise = 0, bool event_mode = true)
      : unit(library, choices(event_mode)) {
    REQUIRE(unit.fmi.EnableIdleSkipping(unit.handle, max_skip) == fmi3OK);
    REQUIRE(unit.set_real("rate", rate) == fmi3OK);
    REQUIRE(unit.set_real("period", period) == fmi3OK);
    REQUIRE(unit.set_boolean("announces", announces) == fmi3OK);
    const fmi3ValueReference reference = unit.reference("promise");
    REQUIRE(unit.fmi.SetInt64(unit.handle, &reference, 1, &promise, 1) == fmi3OK);
    REQUIRE((event_mode ? unit.start_steps() : unit.initialize()) == fmi3OK);
  }
  UnitLibrary library{unit_library("idler")};
  UnitInstance unit;
};

struct State {
  explicit State(UnitInstance& of) : unit(of) {
    REQUIRE(unit.fmi.GetFMUState(unit.handle, &state) == fmi3OK);
  }
  ~State() { unit.fmi.FreeFMUState(unit.handle, &state); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  fmi3Status restore() const { return unit.fmi.SetFMUState(unit.handle, state); }

  UnitInstance& unit;
  fmi3FMUState state = nullptr;
};

}  // namespace

TEST_CASE("what a unit promises it promises without end, if it may") {
  Idler idler;
  CHECK(idler.unit.idle_until() == kEver);
  CHECK(idler.unit.step(0, 1) == fmi3OK);
  CHECK(idler.unit.idle_until() == kEver);
}

TEST_CASE("a promise is cut off at maxSkip after the present instant") {
  Idler idler(0.25);
  CHECK(idler.unit.idle_until() == 0.25);
  CHECK(idler.unit.step(0, 0.1) == fmi3OK);
  CHECK(idler.unit.idle_until() == 0.35);
}

TEST_CASE("a promise ends where the unit does something") {
  Idler idler(10, 0, 0.125);
  CHECK(idler.unit.idle_until() == 0.125);
}

TEST_CASE("a promise is cut off at the event that the unit has announced") {
  Idler idler(10, 0, 3, true);
  CHECK(idler.unit.idle_until() == 3);
  REQUIRE(idler.unit.step(0, 3) == fmi3OK);
  REQUIRE(idler.unit.fmi.EnterEventMode(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.update() == fmi3OK);
  CHECK(idler.unit.iterate);
  REQUIRE(idler.unit.update() == fmi3OK);
  REQUIRE(idler.unit.fmi.EnterStepMode(idler.unit.handle) == fmi3OK);
  CHECK(idler.unit.idle_until() == 6);
}

TEST_CASE("a promise without an end is cut off at the event that the unit has announced") {
  Idler idler(kEver, 0, 3, true, kPromisesEver);
  CHECK(idler.unit.idle_until() == 3);
  REQUIRE(idler.unit.step(0, 1) == fmi3OK);
  CHECK(idler.unit.idle_until() == 3);
}

TEST_CASE("a unit that promises something while it requests an event has promised nothing") {
  Idler idler(kEver, 0, 0.125, false, kPromisesEver);
  CHECK(idler.unit.idle_until() == kEver);
  REQUIRE(idler.unit.step(0, 1) == fmi3OK);
  REQUIRE(idler.unit.last.event);
  CHECK(idler.unit.idle_until() == 0.125);
}

TEST_CASE(
    "without Event Mode a discrete input that was set ends a promise, also where a step fails") {
  Idler idler(kEver, 0, 0, false, kRejects, false);
  CHECK(idler.unit.idle_until() == kEver);
  REQUIRE(idler.unit.set_boolean("mark", true) == fmi3OK);
  CHECK(idler.unit.idle_until() == 0);
  REQUIRE(idler.unit.step(0, 1) == fmi3Discard);
  CHECK(idler.unit.idle_until() == 0);
  REQUIRE(idler.unit.step(0, 0.001) == fmi3OK);
  CHECK(idler.unit.idle_until() == kEver);
}

TEST_CASE("a promise is cut off where one step cannot reach") {
  const UnitLibrary library(unit_library("idler_with_short_steps"));
  UnitInstance unit(library, choices());
  REQUIRE(unit.fmi.EnableIdleSkipping(unit.handle, kEver) == fmi3OK);
  REQUIRE(unit.set_real("rate", 0) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.idle_until() == 0.5);
}

TEST_CASE("an output's own tolerance bounds how long its tangent holds") {
  Idler idler(10, 0.01);
  const double usual = idler.unit.idle_until();
  CHECK(usual == Approx(std::sqrt(2 * 1e-3 / (0.01 * 0.01))).epsilon(1e-3));
  REQUIRE(idler.library.Reset(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.fmi.EnableIdleSkipping(idler.unit.handle, 10) == fmi3OK);
  REQUIRE(idler.unit.set_tolerance("level", 1e-5) == fmi3OK);
  REQUIRE(idler.unit.start_steps() == fmi3OK);
  CHECK(idler.unit.idle_until() == Approx(usual / 10).epsilon(1e-2));
}

TEST_CASE("where skipping is not enabled nothing is promised") {
  const UnitLibrary library(unit_library("idler"));
  UnitInstance unit(library, choices());
  REQUIRE(unit.set_real("rate", 0) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.idle_until() == 0);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK(unit.idle_until() == 1);
}

TEST_CASE("while an event is requested nothing is promised") {
  Idler idler(10, 0, 0.125);
  REQUIRE(idler.unit.step(0, 1) == fmi3OK);
  REQUIRE(idler.unit.last.early);
  REQUIRE(idler.unit.last.event);
  CHECK(idler.unit.idle_until() == 0.125);
  REQUIRE(idler.unit.fmi.EnterEventMode(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.update() == fmi3OK);
  REQUIRE(idler.unit.update() == fmi3OK);
  REQUIRE(idler.unit.fmi.EnterStepMode(idler.unit.handle) == fmi3OK);
  CHECK(idler.unit.idle_until() == 0.25);
}

TEST_CASE("an input that was set since the step counts with its new value") {
  Idler idler(10, 0.01);
  CHECK(idler.unit.idle_until() > 0);
  REQUIRE(idler.unit.set_real("inflow", 2) == fmi3OK);
  CHECK(idler.unit.idle_until() == 0);
}

TEST_CASE("a reset switches skipping off and forgets the tolerances") {
  Idler idler(10, 0.01);
  const double usual = idler.unit.idle_until();
  REQUIRE(idler.library.Reset(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.set_tolerance("level", 1e-5) == fmi3OK);
  REQUIRE(idler.unit.start_steps() == fmi3OK);
  CHECK(idler.unit.idle_until() == 0);
  REQUIRE(idler.library.Reset(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.fmi.EnableIdleSkipping(idler.unit.handle, 10) == fmi3OK);
  REQUIRE(idler.unit.start_steps() == fmi3OK);
  CHECK(idler.unit.idle_until() == usual);
}

TEST_CASE("what was enabled is part of the state") {
  const UnitLibrary library(unit_library("idler"));
  UnitInstance unit(library, choices());
  const State off(unit);
  REQUIRE(unit.fmi.EnableIdleSkipping(unit.handle, 10) == fmi3OK);
  REQUIRE(unit.set_tolerance("level", 1e-5) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  const double promise = unit.idle_until();
  REQUIRE(promise > 0);
  const State on(unit);

  REQUIRE(off.restore() == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.idle_until() == 0);
  REQUIRE(on.restore() == fmi3OK);
  CHECK(unit.idle_until() == promise);
}

TEST_CASE("a requested event is part of the state") {
  Idler idler(10, 0, 0.125);
  REQUIRE(idler.unit.step(0, 1) == fmi3OK);
  const State wanted(idler.unit);
  REQUIRE(idler.unit.fmi.EnterEventMode(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.update() == fmi3OK);
  REQUIRE(idler.unit.update() == fmi3OK);
  REQUIRE(idler.unit.fmi.EnterStepMode(idler.unit.handle) == fmi3OK);
  REQUIRE(idler.unit.idle_until() == 0.25);
  REQUIRE(wanted.restore() == fmi3OK);
  CHECK(idler.unit.idle_until() == 0.125);
}

TEST_CASE("a maxSkip that cannot be is refused, and nothing is enabled") {
  const UnitLibrary library(unit_library("idler"));
  UnitInstance unit(library, choices());
  for (const double max_skip : {0.0, -1.0, 1e-14}) {
    CAPTURE(max_skip);
    CHECK(unit.fmi.EnableIdleSkipping(unit.handle, max_skip) == fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("strideEnableIdleSkipping: maxSkip is ") &&
                                        Contains("expected at least the picosecond"));
  }
  CHECK(unit.fmi.EnableIdleSkipping(unit.handle, kNan) == fmi3Error);
  CHECK(unit.fmi.EnableIdleSkipping(unit.handle, -kEver) == fmi3Error);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.idle_until() == 0);
}

TEST_CASE("a tolerance that cannot be is refused, and none of its call is set") {
  const UnitLibrary library(unit_library("idler"));
  UnitInstance unit(library, choices());
  REQUIRE(unit.fmi.EnableIdleSkipping(unit.handle, 10) == fmi3OK);
  for (const double tolerance : {0.0, -1.0, kNan, kEver}) {
    CAPTURE(tolerance);
    CHECK(unit.set_tolerance("level", tolerance) == fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("the tolerance of 'level' is "));
  }
  CHECK(unit.set_tolerance("inflow", 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("variable 'inflow' is not an output with a tolerance"));
  CHECK(unit.set_tolerance("reports", 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("'reports' is of the type Int64, not Float64"));
  const fmi3ValueReference both[] = {unit.reference("level"), unit.reference("inflow")};
  const double tolerances[] = {1e-9, 1e-9};
  CHECK(unit.fmi.SetIdleTolerances(unit.handle, both, 2, tolerances, 2) == fmi3Error);
  CHECK(unit.fmi.SetIdleTolerances(unit.handle, both, 1, tolerances, 2) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("nTolerances must be nOutputs"));
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.idle_until() == Approx(std::sqrt(2 * 1e-3 / (0.01 * 0.01))).epsilon(1e-3));
}

TEST_CASE("the error of a unit without promises names the missing capability") {
  const UnitLibrary library(unit_library("minimal"));
  CHECK(library.idle_manifest().empty());
  UnitInstance unit(library);
  CHECK(unit.fmi.EnableIdleSkipping(unit.handle, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(),
             Contains("strideEnableIdleSkipping: this unit never promises to be idle"));
  CHECK(unit.fmi.SetIdleTolerances(unit.handle, nullptr, 0, nullptr, 0) == fmi3Error);
  REQUIRE(unit.start_steps() == fmi3OK);
  double until = 0;
  CHECK(unit.fmi.GetIdlePromise(unit.handle, &until) == fmi3Error);
  CHECK(unit.step(0, 0.1) == fmi3OK);
}

TEST_CASE("a NULL instance promises nothing") {
  const UnitLibrary library(unit_library("idler"));
  double until = 0;
  CHECK(library.GetIdlePromise(nullptr, &until) == fmi3Error);
  CHECK(library.EnableIdleSkipping(nullptr, 1) == fmi3Error);
}

TEST_CASE("a library gives its manifest") {
  const UnitLibrary library(unit_library("idler"));
  const std::string manifest = library.idle_manifest();
  CHECK(attribute(manifest, "name=\"inflow\"", "deadband") == "1e-05");
  CHECK(attribute(manifest, "name=\"level\"", "tolerance") == "0.001");
}
