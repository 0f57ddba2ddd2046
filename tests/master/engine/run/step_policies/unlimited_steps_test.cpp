#include "master/engine/run/step_policies/unlimited_steps.h"

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

/// Two units with a continuous and a discrete connection from a to b.
ScriptedSystem connected(Describe source) {
  ScriptedSystem f;
  f.add("a", source.output("y").add("on", ValueType::Boolean, Causality::Output).done());
  f.add("b", Describe("b").input("u").add("go", ValueType::Boolean, Causality::Input).done());
  f.wire("a", "y", "b", "u");
  f.wire("a", "on", "b", "go");
  return f;
}

}  // namespace

TEST_CASE("steps are unlimited where nothing but events ends them") {
  ScriptedSystem f = connected(Describe("a"));
  const auto is_unlimited = [&](double stop, Duration step) {
    f.options.stop = time_from_seconds(stop);
    f.options.step.size = step;
    return has_unlimited_steps(System(f.declaration), f.options);
  };
  SECTION("event-driven") {
    f.options.step.policy = &kEventDrivenSteps;
    CHECK(is_unlimited(1, 1ms));
    CHECK_FALSE(is_unlimited(0, 1ms));
    f.options.step.maximum = 100s;
    CHECK_FALSE(is_unlimited(1, 1ms));
  }
  SECTION("a grid") {
    CHECK_FALSE(is_unlimited(1, 999ms));
    CHECK(is_unlimited(1, 1s));
    f.options.step.maximum = 1s;
    CHECK_FALSE(is_unlimited(1, 1s));
  }
  SECTION("error-controlled") {
    f.options.step.policy = &kErrorControlledSteps;
    CHECK_FALSE(is_unlimited(1, 1s));
  }
}

TEST_CASE("a unit's maximum step limits steps") {
  ScriptedSystem f = connected(Describe("a").maximum_step(10s));
  f.build(1, 2s);
  f.options.step.policy = &kEventDrivenSteps;
  CHECK_FALSE(has_unlimited_steps(*f.system, f.options));
}

TEST_CASE("connections whose values may change without an event") {
  SECTION("of a unit without Event Mode") {
    ScriptedSystem f = connected(Describe("a"));
    f.build(1, 1s);
    CHECK(connections_without_events(*f.system) ==
          std::vector<std::string>{"a.y → b.u", "a.on → b.go"});
  }
  SECTION("discrete outputs of a unit with Event Mode change at its events") {
    ScriptedSystem f = connected(Describe("a").event_mode());
    f.build(1, 1s);
    CHECK(connections_without_events(*f.system) == std::vector<std::string>{"a.y → b.u"});
  }
}

TEST_CASE("messages have events") {
  ScriptedSystem f;
  f.add("a", Describe("a")
                 .add("tick", ValueType::Clock, Causality::Output)
                 .output("m")
                 .clocked_by(0)
                 .done());
  f.add("b", Describe("b")
                 .add("tock", ValueType::Clock, Causality::Input)
                 .input("n")
                 .clocked_by(0)
                 .done());
  f.wire("a", "tick", "b", "tock");
  f.wire("a", "m", "b", "n");
  f.build(1, 1s);
  CHECK(connections_without_events(*f.system).empty());
}

TEST_CASE("events at the end of a step are counted, unless the unit ended it or announced them") {
  ScriptedSystem f;
  f.options.step.policy = &kEventDrivenSteps;
  auto& unit = f.add("a", Describe("a").event_mode().may_return_early().done());
  const auto need_event_at = [&](Time time, bool returns_early) {
    unit.on_step = [=](ScriptedUnit&, Time from, Time to) {
      StepResult result = reached(from < time && time < to ? time : to);
      result.early_return = result.reached < to || returns_early;
      result.event_handling_needed = result.reached == time;
      return result;
    };
  };
  const auto count = [&] {
    f.build(1, 1s).run();
    return f.simulation->statistics().units[0].unannounced_events;
  };
  SECTION("unannounced") {
    need_event_at(Time(1s), false);
    CHECK(count() == 1);
  }
  SECTION("returned early") {
    need_event_at(Time(300ms), true);
    CHECK(count() == 0);
  }
  SECTION("announced") {
    need_event_at(Time(300ms), false);
    unit.on_event = [first = true](ScriptedUnit&) mutable {
      EventResult result;
      if (std::exchange(first, false)) result.next_event_time = Time(300ms);
      return result;
    };
    CHECK(count() == 0);
  }
}
