#include "master/engine/run/verdict.h"

#include <csignal>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

/// The outputs 0 and 1 are the verdict and its text.
std::shared_ptr<const UnitDescription> judge(bool has_text = true) {
  const auto described = Describe("judge")
                             .add("good", ValueType::Boolean, Causality::Output)
                             .add("why", ValueType::String, Causality::Output)
                             .done();
  auto description = std::make_shared<UnitDescription>(*described);
  description->verdict = 0;
  if (has_text) description->verdict_text = 1;
  return description;
}

/// Good from the first step that ends at `time` or later.
void make_good_at(ScriptedUnit& unit, Time time) {
  unit.on_step = [time](ScriptedUnit& self, Time, Time to) {
    self.block(0).numbers<bool>()[0] = to >= time;
    self.block(1).strings()[0] = to >= time ? "it came" : "it did not come";
    return reached(to);
  };
}

bool is_undecided(const Simulation& simulation) {
  const auto verdicts = simulation.verdicts();
  return verdicts.size() == 1 && verdicts[0].name == "judge" && !verdicts[0].passed &&
         verdicts[0].text.empty();
}

}  // namespace

TEST_CASE("margins as texts: all digits, and few") {
  CHECK(to_text(Margin{0.1234567, "V", {}}) == "0.1234567 V");
  CHECK(brief_text(Margin{0.1234567, "V", {}}) == "0.1235 V");
  CHECK(brief_text(Margin{-3580, "", {}}) == "-3580");
  CHECK(to_text(Margin{-std::numeric_limits<double>::infinity(), "s", {}}) == "-inf s");
}

TEST_CASE("verdicts are the units' outputs at the end of the run, in their order") {
  ScriptedSystem fixture;
  make_good_at(fixture.add("late", judge()), Time(20ms));
  fixture.add("silent", Describe("silent").output("y").done());
  make_good_at(fixture.add("early", judge()), Time(10ms));
  make_good_at(fixture.add("terse", judge(false)), Time(1ms));
  Simulation& simulation = fixture.build(0.015, 1ms);
  REQUIRE(simulation.verdicts().size() == 3);
  CHECK((simulation.verdicts()[2].name == "terse" && !simulation.verdicts()[2].passed));
  simulation.run();
  const auto verdicts = simulation.verdicts();
  REQUIRE(verdicts.size() == 3);
  CHECK((verdicts[0].name == "late" && verdicts[0].passed == false));
  CHECK(verdicts[0].text == "it did not come");
  CHECK(
      (verdicts[1].name == "early" && verdicts[1].passed == true && verdicts[1].text == "it came"));
  CHECK((verdicts[2].name == "terse" && verdicts[2].passed == true && verdicts[2].text.empty()));
}

TEST_CASE("the reason names the first failure") {
  Verdict verdict{"voltage", false, "1.7 V; expected >= 1.8 V"};
  CHECK(reason(verdict) == "1.7 V; expected >= 1.8 V");
  verdict.time = Time(1500ms);
  CHECK(reason(verdict) == "at 1.5 s: 1.7 V; expected >= 1.8 V");
  verdict.text.clear();
  CHECK(reason(verdict) == "at 1.5 s");
}

TEST_CASE("verdicts are read before the units are terminated, and only once") {
  ScriptedSystem fixture;
  ScriptedUnit& unit = fixture.add("judge", judge());
  make_good_at(unit, Time(1ms));
  Simulation& simulation = fixture.build(0.01, 1ms);
  simulation.run();
  CHECK(unit.gets == 2);
  CHECK(unit.calls.back() == "terminate");
}

TEST_CASE("a run that has failed is not judged") {
  ScriptedSystem fixture;
  make_good_at(fixture.add("judge", judge()), Time(1ms));
  fixture.add("failing", Describe("failing").done()).on_step = [](ScriptedUnit&, Time,
                                                                  Time to) -> StepResult {
    if (to > Time(5ms)) fail_run({}, "enough");
    return reached(to);
  };
  Simulation& simulation = fixture.build(0.01, 1ms);
  CHECK_THROWS_AS(simulation.run(), Error);
  CHECK(is_undecided(simulation));
}

TEST_CASE("an interrupted run ends well at its next communication point, and is not judged") {
  ScriptedSystem fixture;
  ScriptedUnit& unit = fixture.add("judge", judge());
  volatile std::sig_atomic_t interrupted = 0;
  unit.on_step = [&](ScriptedUnit&, Time, Time to) {
    interrupted = to == Time(4ms) ? 1 : 0;
    return reached(to);
  };
  fixture.options.interrupted = &interrupted;
  Simulation& simulation = fixture.build(0.01, 1ms);
  simulation.run();
  CHECK(simulation.statistics().reached == Time(4ms));
  CHECK(simulation.statistics().end == RunEnd::Interrupted);
  CHECK(is_undecided(simulation));
  CHECK(unit.calls.back() == "terminate");
}

TEST_CASE("a run that a unit ends is judged there") {
  ScriptedSystem fixture;
  make_good_at(fixture.add("judge", judge()), Time(5ms));
  fixture.add("ending", Describe("ending").done()).on_step = [](ScriptedUnit&, Time, Time to) {
    StepResult result = reached(to);
    result.terminate_simulation = to == Time(4ms);
    return result;
  };
  Simulation& simulation = fixture.build(0.01, 1ms);
  simulation.run();
  REQUIRE(simulation.verdicts().size() == 1);
  CHECK(simulation.verdicts()[0].passed == false);
}
