// Time-based clocks through the C entry points, as FMI 3.0, 2.2.8 has them.
#include <functional>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

struct Fixture {
  UnitLibrary library{unit_library("clocks")};
  UnitInstance unit{library};

  Fixture() { REQUIRE(unit.handle != nullptr); }
  void enter_initialization() {
    REQUIRE(unit.fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  }
  /// To Event Mode, before the first event.
  void start() {
    enter_initialization();
    REQUIRE(unit.fmi.ExitInitializationMode(unit.handle) == fmi3OK);
  }
  /// From Event Mode to the Event Mode at a later time.
  void go_on(double from, double to) {
    REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
    REQUIRE(unit.step(from, to - from) == fmi3OK);
    REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  }
};

std::string why(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it was accepted";
}

}  // namespace

TEST_CASE("the model description has the attributes that each kind of clock may have") {
  const std::string xml = UnitLibrary(unit_library("clocks")).describe();
  CHECK_THAT(xml, Contains(R"(<Clock name="constant" valueReference="3" causality="input" )"
                           R"(intervalVariability="constant" intervalDecimal="0.003" )"
                           R"(shiftDecimal="0.001" supportsFraction="true" )"
                           R"(resolution="1000000000000" intervalCounter="3000000000" )"
                           R"(shiftCounter="1000000000"/>)"));
  for (const char* name : {"fixed_by_unit", "tunable_by_unit", "changing", "countdown"}) {
    const std::string row = std::string("<Clock name=\"") + name + "\"";
    CHECK(attribute(xml, row, "intervalDecimal").empty());
    CHECK(attribute(xml, row, "resolution").empty());
    CHECK(attribute(xml, row, "supportsFraction") == "true");
  }
  CHECK(attribute(xml, "<Clock name=\"triggered\"", "supportsFraction").empty());
}

TEST_CASE("intervals that are declared are never news") {
  Fixture f;
  f.enter_initialization();
  for (const auto& [clock, seconds] :
       {std::pair("constant", 0.003), {"fixed", 0.005}, {"tunable", 0.007}}) {
    CHECK(f.unit.interval(clock).seconds == seconds);
    CHECK(f.unit.interval(clock).qualifier == fmi3IntervalUnchanged);
  }
  const auto said = f.unit.interval_fraction("tunable");
  CHECK(said.counter == 7'000'000'000);
  CHECK(said.resolution == 1'000'000'000'000);
  CHECK(f.unit.shift("constant") == 0.001);
  CHECK(f.unit.shift("fixed") == 0);
  CHECK(f.unit.shift("tunable") == 0.0005);
}

TEST_CASE("intervals that the unit determines follow its parameters before the start") {
  Fixture f;
  REQUIRE(f.unit.set_real("interval", 0.0125) == fmi3OK);
  f.enter_initialization();
  CHECK(f.unit.interval("fixed_by_unit").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval("fixed_by_unit").qualifier == fmi3IntervalUnchanged);
  CHECK(f.unit.interval("fixed_by_unit").seconds == 0.0125);
  REQUIRE(f.unit.set_real("interval", 0.025) == fmi3OK);
  REQUIRE(f.unit.set_real("shift", 0.125) == fmi3OK);
  CHECK(f.unit.interval("fixed_by_unit").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval("tunable_by_unit").seconds == 0.025);
  CHECK(f.unit.shift("fixed_by_unit") == 0.125);
  CHECK(f.unit.shift("tunable_by_unit") == 0.125);
}

TEST_CASE("a tunable interval is news when a parameter changed it, a fixed one cannot change") {
  Fixture f;
  f.enter_initialization();
  f.unit.interval("tunable_by_unit");
  f.unit.interval("fixed_by_unit");
  REQUIRE(f.unit.fmi.ExitInitializationMode(f.unit.handle) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("tunable_by_unit").qualifier == fmi3IntervalUnchanged);
  REQUIRE(f.unit.set_real("interval", 0.25) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("tunable_by_unit").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval("tunable_by_unit").qualifier == fmi3IntervalUnchanged);
  CHECK(f.unit.interval("tunable_by_unit").seconds == 0.25);
  CHECK(f.unit.interval("fixed_by_unit").qualifier == fmi3IntervalUnchanged);
  CHECK(f.unit.interval("fixed_by_unit").seconds == 0.002);
}

TEST_CASE("a countdown is not known until the unit begins it, and not after its tick") {
  Fixture f;
  f.enter_initialization();
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalNotYetKnown);
  REQUIRE(f.unit.fmi.ExitInitializationMode(f.unit.handle) == fmi3OK);
  REQUIRE(f.unit.set_boolean("start", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval_fraction("countdown").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval_fraction("countdown").counter == 4'000'000'000);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalUnchanged);
  f.go_on(0, 0.004);
  REQUIRE(f.unit.set_clock("countdown", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalNotYetKnown);
  CHECK(f.unit.integer("countdown.ticks") == 1);
  CHECK(f.unit.real("countdown.last") == 0.004);
}

TEST_CASE("a changing interval is news at each tick, and only there") {
  Fixture f;
  f.enter_initialization();
  CHECK(f.unit.interval("changing").seconds == 0.001);
  REQUIRE(f.unit.fmi.ExitInitializationMode(f.unit.handle) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("changing").qualifier == fmi3IntervalUnchanged);
  f.go_on(0, 0.001);
  REQUIRE(f.unit.set_clock("changing", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("changing").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval("changing").seconds == 0.002);
}

TEST_CASE("a tick is there for one super-dense instant") {
  Fixture f;
  f.start();
  REQUIRE(f.unit.set_clock("constant", true) == fmi3OK);
  CHECK(f.unit.clock("constant"));
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK_FALSE(f.unit.clock("constant"));
  CHECK_FALSE(f.unit.iterate);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.integer("constant.ticks") == 1);
}

TEST_CASE("the importer chooses the intervals of fixed and tunable clocks that declare one") {
  Fixture f;
  f.enter_initialization();
  REQUIRE(f.unit.set_interval("fixed", 0.125) == fmi3OK);
  REQUIRE(f.unit.set_shift("fixed", 0.25) == fmi3OK);
  CHECK(f.unit.interval("fixed").seconds == 0.125);
  CHECK(f.unit.interval("fixed").qualifier == fmi3IntervalUnchanged);
  CHECK(f.unit.shift("fixed") == 0.25);
  const fmi3ValueReference r = f.unit.reference("tunable");
  fmi3UInt64 counter = 1;
  fmi3UInt64 resolution = 3;
  REQUIRE(f.unit.fmi.SetIntervalFraction(f.unit.handle, &r, 1, &counter, &resolution) == fmi3OK);
  CHECK(f.unit.interval_fraction("tunable").counter == 333'333'333'333);
  REQUIRE(f.unit.fmi.ExitInitializationMode(f.unit.handle) == fmi3OK);
  REQUIRE(f.unit.set_interval("tunable", 0.5) == fmi3OK);
  CHECK(f.unit.interval("tunable").seconds == 0.5);
  CHECK(f.unit.set_interval("fixed", 0.5) == fmi3Error);
  CHECK_THAT(f.unit.last_message(),
             Contains("clock 'fixed' is fixed") && Contains("only in Initialization Mode"));
}

TEST_CASE("what a clock's kind does not allow is refused, and changes nothing") {
  Fixture f;
  f.enter_initialization();
  CHECK_THAT(why([&] { f.unit.interval("triggered"); }),
             Contains("fmi3GetIntervalDecimal: clock 'triggered' is triggered"));
  CHECK_THAT(why([&] { f.unit.interval_fraction("triggered"); }), Contains("is triggered"));
  CHECK_THAT(why([&] { f.unit.shift("countdown"); }),
             Contains("clock 'countdown' is a countdown clock, only periodic ones have a shift"));
  CHECK_THAT(why([&] { f.unit.interval("start"); }), Contains("of the type Boolean, not Clock"));
  CHECK(f.unit.set_interval("constant", 1) == fmi3Error);
  CHECK_THAT(f.unit.last_message(), Contains("only the intervals of fixed and tunable ones"));
  CHECK(f.unit.set_interval("fixed_by_unit", 1) == fmi3Error);
  CHECK_THAT(f.unit.last_message(), Contains("whose interval the unit determines"));
  CHECK(f.unit.set_interval("fixed", 0) == fmi3Error);
  CHECK(f.unit.set_interval("fixed", -1) == fmi3Error);
  CHECK(f.unit.set_interval("fixed", 1e300) == fmi3Error);
  CHECK(f.unit.set_shift("fixed", -1) == fmi3Error);
  const fmi3ValueReference both[] = {f.unit.reference("fixed"), f.unit.reference("constant")};
  const double seconds[] = {1, 1};
  CHECK(f.unit.fmi.SetIntervalDecimal(f.unit.handle, both, 2, seconds) == fmi3Error);
  const fmi3UInt64 counter = 1;
  const fmi3UInt64 zero = 0;
  CHECK(f.unit.fmi.SetIntervalFraction(f.unit.handle, both, 1, &counter, &zero) == fmi3Error);
  CHECK_THAT(f.unit.last_message(), Contains("the resolution is 0"));
  const fmi3UInt64 most = ~fmi3UInt64{0};
  CHECK(f.unit.fmi.SetIntervalFraction(f.unit.handle, both, 1, &most, &counter) == fmi3Error);
  CHECK(f.unit.interval("fixed").seconds == 0.005);
  CHECK(f.unit.shift("fixed") == 0);
}

TEST_CASE("a saved state holds what is counted down, and what the importer knows of it") {
  Fixture f;
  f.start();
  REQUIRE(f.unit.set_boolean("start", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  fmi3FMUState news = nullptr;
  REQUIRE(f.unit.fmi.GetFMUState(f.unit.handle, &news) == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalChanged);
  fmi3FMUState told = nullptr;
  REQUIRE(f.unit.fmi.GetFMUState(f.unit.handle, &told) == fmi3OK);
  f.go_on(0, 0.004);
  REQUIRE(f.unit.set_clock("countdown", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalNotYetKnown);
  REQUIRE(f.unit.fmi.SetFMUState(f.unit.handle, told) == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalUnchanged);
  REQUIRE(f.unit.fmi.SetFMUState(f.unit.handle, news) == fmi3OK);
  CHECK(f.unit.interval("countdown").qualifier == fmi3IntervalChanged);
  CHECK(f.unit.interval("countdown").seconds == 0.004);
  f.unit.fmi.FreeFMUState(f.unit.handle, &news);
  f.unit.fmi.FreeFMUState(f.unit.handle, &told);
}

TEST_CASE("a clock has ticked when its event is over") {
  Fixture f;
  f.start();
  REQUIRE(f.unit.set_clock("triggered", true) == fmi3OK);
  REQUIRE(f.unit.update() == fmi3OK);
  std::int32_t ticks = 0, late = -1;
  const fmi3ValueReference references[] = {f.unit.reference("triggered.ticks"),
                                           f.unit.reference("late_ticks")};
  REQUIRE(f.library.GetInt32(f.unit.handle, &references[0], 1, &ticks, 1) == fmi3OK);
  REQUIRE(f.library.GetInt32(f.unit.handle, &references[1], 1, &late, 1) == fmi3OK);
  CHECK(ticks == 1);
  CHECK(late == 0);
}
