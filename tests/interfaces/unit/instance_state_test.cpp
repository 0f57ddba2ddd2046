// States through the C entry points: saved, restored, serialised.
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/interfaces/unit/saved_state.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

TEST_CASE("a restored state continues as if nothing had happened between") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  const SavedState saved(unit);
  REQUIRE(unit.step(0.1, 0.1) == fmi3OK);
  const double position = unit.real("position");
  REQUIRE(unit.step(0.2, 0.3) == fmi3OK);
  REQUIRE(library.SetFMUState(unit.handle, saved.state) == fmi3OK);
  CHECK(unit.real("time") == 0.1);
  CHECK(unit.integer("steps") == 1);
  REQUIRE(unit.step(0.1, 0.1) == fmi3OK);
  CHECK(unit.real("position") == position);
}

TEST_CASE("a restored state brings back the mode and what state() does not list") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("event_at", 0.0) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  const SavedState saved(unit);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.iterate);
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(library.SetFMUState(unit.handle, saved.state) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.iterate);
}

TEST_CASE("a saved state is reused where the importer passes it again") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  SavedState saved(unit);
  const fmi3FMUState before = saved.state;
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  REQUIRE(library.GetFMUState(unit.handle, &saved.state) == fmi3OK);
  CHECK(saved.state == before);
  REQUIRE(library.SetFMUState(unit.handle, saved.state) == fmi3OK);
  CHECK(unit.integer("steps") == 1);
}

TEST_CASE("a serialised state continues in another instance") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance first(library);
  REQUIRE(first.initialize() == fmi3OK);
  REQUIRE(first.set_real("float64", 2.5) == fmi3OK);
  const fmi3ValueReference text = first.reference("string");
  fmi3String words = "some words";
  REQUIRE(library.SetString(first.handle, &text, 1, &words, 1) == fmi3OK);
  REQUIRE(first.set_clock("receive.clock", true) == fmi3OK);
  const SavedState saved(first);
  const std::vector<fmi3Byte> bytes = serialize(first, saved.state);

  UnitInstance second(library);
  fmi3FMUState copy = nullptr;
  REQUIRE(library.DeserializeFMUState(second.handle, bytes.data(), bytes.size(), &copy) == fmi3OK);
  REQUIRE(library.SetFMUState(second.handle, copy) == fmi3OK);
  CHECK(serialize(second, copy) == bytes);
  REQUIRE(library.FreeFMUState(second.handle, &copy) == fmi3OK);
  CHECK(copy == nullptr);
  CHECK(second.real("float64.echo") == 2.5);
  REQUIRE(library.GetString(second.handle, &text, 1, &words, 1) == fmi3OK);
  CHECK(std::string(words) == "some words");
  REQUIRE(second.update() == fmi3OK);
  CHECK(second.clock("send.clock"));
}

TEST_CASE("bytes that are not a state of this unit are refused, and leave the instance as it was") {
  const UnitLibrary types(unit_library("types"));
  const UnitLibrary stepper(unit_library("stepper"));
  UnitInstance source(types);
  UnitInstance unit(stepper);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  const std::vector<fmi3Byte> own = serialized(unit);
  const auto check_refused = [&](const std::vector<fmi3Byte>& bytes, const std::string& why) {
    CAPTURE(bytes.size());
    fmi3FMUState state = nullptr;
    CHECK(stepper.DeserializeFMUState(unit.handle, bytes.data(), bytes.size(), &state) ==
          fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("not a saved state of this unit") && Contains(why));
    CHECK(state == nullptr);
  };
  check_refused(serialized(source), "of the unit 'types', expected 'stepper'");
  check_refused({1, 2, 3}, "there are 3 bytes, expected 40 at least");
  check_refused({}, "there are 0 bytes");
  std::vector<fmi3Byte> bytes = own;
  bytes.pop_back();
  check_refused(bytes, "expected the " + std::to_string(own.size()) + " that were written");
  bytes = own;
  bytes.back() ^= 1;
  check_refused(bytes, "damaged");
  CHECK(serialized(unit) == own);
  CHECK(unit.step(0.1, 0.1) == fmi3OK);
}

TEST_CASE("a refused state leaves the one that the importer passes for it as it was") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  SavedState saved(unit);
  const std::vector<fmi3Byte> own = serialize(unit, saved.state);
  const fmi3Byte other[64] = {};
  CHECK(library.DeserializeFMUState(unit.handle, other, sizeof other, &saved.state) == fmi3Error);
  CHECK(serialize(unit, saved.state) == own);
}

TEST_CASE("a serialised state that the unit itself refuses leaves the instance as it was") {
  const UnitLibrary library(unit_library("thrower"));
  UnitInstance source(library);
  REQUIRE(source.set_boolean("refuses_states", true) == fmi3OK);
  REQUIRE(source.start_steps() == fmi3OK);
  const std::vector<fmi3Byte> refused = serialized(source);
  UnitInstance unit(library);
  REQUIRE(unit.set_real("throw_at", 1) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  const std::vector<fmi3Byte> own = serialized(unit);
  CHECK(restore(unit, refused) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("is as it was before: it takes no state like this"));
  CHECK(serialized(unit) == own);
  CHECK(unit.step(0.1, 0.1) == fmi3OK);
  CHECK(unit.integer("steps") == 2);
}

TEST_CASE("a state is of an instance with Event Mode, or of one without") {
  const UnitLibrary library(unit_library("stepper"));
  InstanceChoices without;
  without.event_mode = false;
  UnitInstance source(library, without);
  UnitInstance unit(library);
  CHECK(restore(unit, serialized(source)) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("an instance without Event Mode"));
}

TEST_CASE("what was restored from bytes is serialised to the same bytes in each mode") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  const auto check_same = [&] {
    const std::vector<fmi3Byte> bytes = serialized(unit);
    UnitInstance fresh(library);
    REQUIRE(restore(fresh, bytes) == fmi3OK);
    CHECK(serialized(fresh) == bytes);
    UnitInstance running(library);
    REQUIRE(running.set_real("event_at", 7) == fmi3OK);
    REQUIRE(running.start_steps() == fmi3OK);
    REQUIRE(running.step(0, 0.25) == fmi3OK);
    REQUIRE(restore(running, bytes) == fmi3OK);
    CHECK(serialized(running) == bytes);
  };
  REQUIRE(unit.set_real("event_at", 0.5) == fmi3OK);
  check_same();
  REQUIRE(unit.initialize() == fmi3OK);
  check_same();
  REQUIRE(unit.update() == fmi3OK);
  check_same();
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(unit.step(0, 0.125) == fmi3OK);
  check_same();
  REQUIRE(library.Terminate(unit.handle) == fmi3OK);
  check_same();
}

TEST_CASE("the stop time is the importer's, not the state's") {
  const UnitLibrary library(unit_library("stepper"));
  const auto initialize_until = [&](UnitInstance& unit, double stop) {
    REQUIRE(library.EnterInitializationMode(unit.handle, false, 0, 0, true, stop) == fmi3OK);
    REQUIRE(library.ExitInitializationMode(unit.handle) == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  };
  UnitInstance unit(library);
  initialize_until(unit, 1);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK(unit.step(1, 1) == fmi3Error);
  const std::vector<fmi3Byte> bytes = serialized(unit);
  UnitInstance fresh(library);
  REQUIRE(restore(fresh, bytes) == fmi3OK);
  CHECK(fresh.step(1, 1) == fmi3OK);
  UnitInstance later(library);
  initialize_until(later, 2);
  REQUIRE(restore(later, bytes) == fmi3OK);
  CHECK(later.step(1, 1) == fmi3OK);
  CHECK(later.step(2, 1) == fmi3Error);
}

TEST_CASE("NULL in the place of a state or too small a buffer is a misuse, not a crash") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  CHECK(library.SetFMUState(unit.handle, nullptr) == fmi3Error);
  std::size_t size = 0;
  CHECK(library.SerializedFMUStateSize(unit.handle, nullptr, &size) == fmi3Error);
  const SavedState saved(unit);
  fmi3Byte byte = 0;
  CHECK(library.SerializeFMUState(unit.handle, saved.state, &byte, 1) == fmi3Error);
  fmi3FMUState nothing = nullptr;
  CHECK(library.FreeFMUState(unit.handle, &nothing) == fmi3OK);
  CHECK(library.FreeFMUState(unit.handle, nullptr) == fmi3OK);
}

TEST_CASE("a state has all elements of the arrays") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  const fmi3ValueReference matrix = unit.reference("matrix");
  const fmi3ValueReference words = unit.reference("words");
  const auto set = [&](std::array<double, 6> numbers, std::array<const char*, 2> texts) {
    REQUIRE(library.SetFloat64(unit.handle, &matrix, 1, numbers.data(), 6) == fmi3OK);
    REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
    REQUIRE(library.SetString(unit.handle, &words, 1, texts.data(), 2) == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  };
  set({6, 5, 4, 3, 2, 1}, {"one", "two"});
  SavedState saved(unit);
  set({0, 0, 0, 0, 0, 0}, {"", ""});
  REQUIRE(library.SetFMUState(unit.handle, saved.state) == fmi3OK);
  std::array<double, 6> numbers{};
  std::array<const char*, 2> texts{};
  REQUIRE(library.GetFloat64(unit.handle, &matrix, 1, numbers.data(), 6) == fmi3OK);
  REQUIRE(library.GetString(unit.handle, &words, 1, texts.data(), 2) == fmi3OK);
  CHECK(numbers == std::array<double, 6>{6, 5, 4, 3, 2, 1});
  CHECK(std::string(texts[0]) == "one");
  CHECK(std::string(texts[1]) == "two");
}
