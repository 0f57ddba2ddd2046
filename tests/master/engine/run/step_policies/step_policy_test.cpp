#include "master/engine/run/step_policies/step_policy.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"
#include "tests/master/engine/run/two_masses.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

std::string refusal(ScriptedSystem& system) {
  try {
    system.build(1, 10ms);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    return error.what();
  }
  return "none";
}

/// Announces an event at each of these instants.
void announce(ScriptedUnit& unit, std::vector<Time> instants) {
  const auto time = std::make_shared<Time>();
  unit.on_step = [time](ScriptedUnit&, Time, Time to) { return *time = to, reached(to); };
  unit.on_event = [time, instants](ScriptedUnit&) {
    EventResult result;
    for (const Time instant : instants) {
      if (instant > *time && !result.next_event_time) result.next_event_time = instant;
    }
    return result;
  };
}

struct Outcome {
  double deviation;
  RunStatistics statistics;
};
Outcome controlled(double tolerance, Extrapolation extrapolation = Extrapolation::Linear) {
  ScriptedSystem system;
  TwoMasses masses(system);
  system.options.step.policy = &kErrorControlledSteps;
  system.options.step.relative_tolerance = 0;
  system.options.step.absolute_tolerance = tolerance;
  system.options.extrapolation = extrapolation;
  Deviation deviation(system);
  system.build(5, 10ms).add_observer(deviation);
  system.simulation->run();
  return {deviation.largest, system.simulation->statistics()};
}

}  // namespace

TEST_CASE("event-driven steps go from event to event, and no further than the maximum") {
  ScriptedSystem f;
  announce(f.add("a", Describe("a").event_mode().done()), {Time(70ms), Time(500ms)});
  f.options.step.policy = &kEventDrivenSteps;
  SECTION("without a maximum") {
    CHECK(points(f, 1, 1ms) == std::vector<Time>{Time(), Time(70ms), Time(500ms), Time(1s)});
  }
  SECTION("with one") {
    f.options.step.maximum = 300ms;
    CHECK(points(f, 1, 1ms) ==
          std::vector<Time>{Time(), Time(70ms), Time(370ms), Time(500ms), Time(800ms), Time(1s)});
  }
}

TEST_CASE("no step is longer than a unit's maximum step") {
  ScriptedSystem f;
  f.add("a", Describe("a").maximum_step(40ms).done());
  f.add("b", Describe("b").maximum_step(60ms).done());
  SECTION("on a grid") {
    CHECK(points(f, 0.2, 100ms) == std::vector<Time>{Time(), Time(40ms), Time(80ms), Time(100ms),
                                                     Time(140ms), Time(180ms), Time(200ms)});
  }
  SECTION("event-driven") {
    f.options.step.policy = &kEventDrivenSteps;
    CHECK(points(f, 0.1, 100ms) == std::vector<Time>{Time(), Time(40ms), Time(80ms), Time(100ms)});
  }
}

TEST_CASE("steps of a third of a second meet the whole seconds") {
  ScriptedSystem f;
  std::vector<StepInterval> steps;
  f.options.steps_in_stretches = GENERATE(true, false);
  Describe a("a");
  if (GENERATE(true, false)) a.fixed_step();
  f.add("a", a.done()).on_interval = [&](const auto& interval) { steps.push_back(interval); };
  f.build(100, Interval::from_fraction(1, 3)).run();
  REQUIRE(steps.size() == 300);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    REQUIRE(steps[k].begin_seconds == static_cast<double>(k) / 3);
    REQUIRE(steps[k].size_seconds == 1.0 / 3);
  }
}

TEST_CASE("a maximum of a third of a second allows steps of a third of a second") {
  const auto third = GENERATE(Interval::from_fraction(1, 3), Interval(Duration(333'333'333'333)));
  ScriptedSystem f;
  f.add("a", Describe("a").maximum_step(third).done());
  f.add("b", Describe("b").maximum_step(third).done());
  f.declaration.components[1].own_step = Interval::from_fraction(1, 3);
  f.options.step.maximum = third;
  CHECK(points(f, 1, Interval::from_fraction(1, 3)) ==
        std::vector<Time>{Time(), Time(Duration(333'333'333'333)), Time(Duration(666'666'666'667)),
                          Time(1s)});
}

TEST_CASE("what remains of a run is part of its last step if it is negligible") {
  ScriptedSystem f;
  f.add("a", Describe("a").maximum_step(Duration(333'333'333'333)).done());
  CHECK(points(f, 1, Duration(333'333'333'333)) ==
        std::vector<Time>{Time(), Time(Duration(333'333'333'333)), Time(Duration(666'666'666'666)),
                          Time(1s)});
}

TEST_CASE("internal steps of a third of a second meet the whole seconds") {
  ScriptedSystem f;
  f.add("a", Describe("a").fixed_internal_step(Interval::from_fraction(1, 3)).done());
  f.options.step.policy = &kEventDrivenSteps;
  f.options.step.maximum = 900ms;
  CHECK(points(f, 2, 1ms) == std::vector<Time>{Time(), Time(Duration(666'666'666'667)),
                                               Time(Duration(1'333'333'333'333)), Time(2s)});
}

TEST_CASE("steps that are not on a grid end on the units' internal steps") {
  ScriptedSystem f;
  announce(f.add("a", Describe("a").event_mode().done()), {Time(25ms)});
  f.add("b", Describe("b").fixed_internal_step(4ms).done());
  f.add("c", Describe("c").fixed_internal_step(6ms).done());
  f.options.step.policy = &kEventDrivenSteps;
  f.options.step.maximum = 20ms;
  CHECK(points(f, 0.06, 1ms) == std::vector<Time>{Time(), Time(12ms), Time(24ms), Time(25ms),
                                                  Time(36ms), Time(48ms), Time(60ms)});
}

TEST_CASE("where no end of an internal step is near enough, the maximum step counts") {
  ScriptedSystem f;
  f.add("a", Describe("a").fixed_internal_step(4ms).can_save_state().done());
  f.add("b", Describe("b").fixed_internal_step(6ms).can_save_state().done());
  f.options.step.policy = GENERATE(&kEventDrivenSteps, &kErrorControlledSteps);
  SECTION("that of a unit") {
    f.add("c", Describe("c").maximum_step(10ms).can_save_state().done());
    f.options.step.maximum = 1s;
    CHECK(points(f, 0.03, 10ms) ==
          std::vector<Time>{Time(), Time(10ms), Time(12ms), Time(22ms), Time(30ms)});
  }
  SECTION("that of the user") {
    f.options.step.maximum = 5ms;
    CHECK(points(f, 0.012, 5ms) == std::vector<Time>{Time(), Time(5ms), Time(10ms), Time(12ms)});
  }
}

TEST_CASE("the error-controlled step is not shorter than an internal step") {
  ScriptedSystem f;
  f.add("a", Describe("a").fixed_internal_step(4ms).can_save_state().done());
  f.options.step.policy = &kErrorControlledSteps;
  f.options.step.maximum = 4ms;
  CHECK(points(f, 0.012, 1ms) == std::vector<Time>{Time(), Time(4ms), Time(8ms), Time(12ms)});
}

TEST_CASE("each policy that can be chosen has a name of its own and can be made and described") {
  ScriptedSystem f;
  f.add("a", Describe("a").can_save_state().done());
  const System system(f.declaration);
  RunOptions options;
  options.stop = Time(1s);
  options.step.size = 10ms;
  std::set<std::string> names;
  for (const StepPolicyType* policy : kStepPolicies) {
    CAPTURE(policy->name);
    options.step.policy = policy;
    CHECK(names.insert(policy->name).second);
    CHECK(make_step_policy(system, options)->next(Time()) > Time());
    CHECK_FALSE(policy->describe(options.step).empty());
  }
}

TEST_CASE("what a policy requires of the units is checked without a run") {
  ScriptedSystem f;
  f.add("rigid", Describe("a").fixed_step().done());
  const System system(f.declaration);
  RunOptions options;
  options.stop = Time(1s);
  options.step.size = 10ms;
  CHECK_NOTHROW(check_step_policy(system, options));
  options.step.policy = &kEventDrivenSteps;
  CHECK_THROWS_WITH(check_step_policy(system, options), Contains("one size only: 'rigid'"));
}

TEST_CASE("policies that vary the step refuse a unit that cannot") {
  ScriptedSystem f;
  f.add("rigid", Describe("a").fixed_step().can_save_state().done());
  SECTION("event-driven") { f.options.step.policy = &kEventDrivenSteps; }
  SECTION("error-controlled") { f.options.step.policy = &kErrorControlledSteps; }
  SECTION("a grid with a maximum") { f.options.step.maximum = 1ms; }
  CHECK_THAT(refusal(f), Contains("one size only: 'rigid'"));
}

TEST_CASE("an error-controlled step refuses units that cannot be rolled back") {
  ScriptedSystem f;
  f.add("a", Describe("a").done());
  f.add("b", Describe("b").can_save_state().done());
  f.add("c", Describe("c").done());
  f.options.step.policy = &kErrorControlledSteps;
  CHECK_THAT(refusal(f), Contains("cannot be rolled back: 'a', 'c'") &&
                             Contains("canGetAndSetFMUState") &&
                             Contains("leave process=\"false\" and snapshots=\"false\" of their") &&
                             Contains("the policy 'fixed'"));
}

TEST_CASE("an error-controlled step asks for no snapshots of units that allow none") {
  ScriptedSystem f;
  f.add("a", Describe("a").allows_no_snapshots().done());
  f.options.step.policy = &kErrorControlledSteps;
  CHECK_THAT(refusal(f),
             Contains("'a'") && Contains("use the policy 'fixed'") && !Contains("snapshots"));
}

TEST_CASE("the error-controlled step follows the tolerance") {
  const auto extrapolation =
      GENERATE(Extrapolation::Hold, Extrapolation::Linear, Extrapolation::Quadratic);
  CAPTURE(name(extrapolation));
  const Outcome loose = controlled(1e-2, extrapolation);
  const Outcome strict = controlled(1e-4, extrapolation);
  CHECK(strict.deviation < loose.deviation / 5);
  CHECK(loose.deviation < 0.3);
  CHECK(strict.statistics.communication_steps > 2 * loose.statistics.communication_steps);
  CHECK(strict.statistics.reached == Time(5s));
}

TEST_CASE("a step that was too long is undone by all units and counted") {
  ScriptedSystem system;
  TwoMasses masses(system);
  system.options.step.policy = &kErrorControlledSteps;
  system.options.step.absolute_tolerance = 1e-4;
  system.build(5, 500ms).run();
  const RunStatistics& statistics = system.simulation->statistics();
  CHECK(statistics.undone_steps > 0);
  CHECK(statistics.units[0].rollbacks == statistics.undone_steps);
  CHECK(statistics.units[1].rollbacks == statistics.undone_steps);
  CHECK(statistics.units[0].steps == statistics.communication_steps + statistics.undone_steps);
}

TEST_CASE("a jump that no step is short enough for is an error that names the output") {
  const double high = GENERATE(1.0, std::numeric_limits<double>::infinity());
  const bool has_internal_step = GENERATE(false, true);
  ScriptedSystem f;
  Describe description("jumper");
  if (has_internal_step) description.fixed_internal_step(10ms);
  auto& jumper = f.add("jumper", description.output("y").can_save_state().done());
  jumper.on_step = [high](ScriptedUnit& self, Time, Time to) {
    self.number(0) = to > Time(300ms) ? high : 0;
    return reached(to);
  };
  f.add("reader", Describe("reader").input("u").can_save_state().done());
  f.wire("jumper", "y", "reader", "u");
  f.options.step.policy = &kErrorControlledSteps;
  f.options.step.minimum = 1us;
  try {
    f.build(1, 10ms).run();
    FAIL("the jump was not noticed");
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Contains("unit 'jumper', variable 'y', at 0."));
    CHECK_THAT(error.what(),
               Contains(has_internal_step ? "no shorter step is possible, since steps end on the "
                                            "units' fixed internal steps (fixedInternalStepSize) "
                                            "of 0.01 s"
                                          : "no shorter step is allowed"));
  }
}

TEST_CASE("an event between two error-controlled steps does not shorten those after it") {
  ScriptedSystem f;
  announce(f.add("a", Describe("a").event_mode().can_save_state().done()),
           {Time(100ms), Time(100ms + 1ns)});
  f.options.step.policy = &kErrorControlledSteps;
  CHECK(points(f, 1, 100ms) == std::vector<Time>{Time(), Time(100ms), Time(100ms + 1ns),
                                                 Time(200ms + 1ns), Time(300ms + 1ns),
                                                 Time(400ms + 1ns), Time(500ms + 1ns),
                                                 Time(600ms + 1ns), Time(700ms + 1ns),
                                                 Time(800ms + 1ns), Time(900ms + 1ns), Time(1s)});
}
