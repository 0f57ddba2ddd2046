#include "master/engine/run/stepping/own_steps.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/base/time_text.h"
#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;
using stride::tests::at;

namespace {

using Calls = ScriptedUnit::Calls;

Describe io_unit() { return Describe("io").input("u").output("y").never_rejects(); }

/// Notes each step and the input in it; y is the time that was reached.
auto noting(std::size_t most = 1000) {
  return [most](ScriptedUnit& unit, Time from, Time to) {
    if (unit.calls.size() < most) {
      unit.calls.push_back(fmt::format("{}-{}: {}", to_text(from), to_text(to), unit.number(0)));
    }
    unit.number(1) = to_seconds(to);
    return reached(to);
  };
}

/// The steps alone.
Calls steps_of(const ScriptedUnit& unit) {
  Calls steps;
  for (const std::string& call : unit.calls) {
    if (call.find(':') != call.npos) steps.push_back(call);
  }
  return steps;
}

/// `fast` feeds `slow`, which feeds `fast`; both note their steps.
struct TwoRates : ScriptedSystem {
  ScriptedUnit& fast;
  ScriptedUnit& slow;

  explicit TwoRates(Duration step, Describe of_fast = io_unit(), Describe of_slow = io_unit())
      : fast(add("fast", of_fast.done())), slow(add("slow", of_slow.done())) {
    declaration.components[1].own_step = step;
    fast.on_step = slow.on_step = noting();
    wire("fast", "y", "slow", "u");
    wire("slow", "y", "fast", "u");
  }
};

/// Sends at these instants a message with a number, in events that it announces.
auto message_system() {
  return Describe("sender")
      .add("clock", ValueType::Clock, Causality::Output)
      .add("value", ValueType::Float64, Causality::Output)
      .clocked_by(0);
}

}  // namespace

TEST_CASE("a component is called at the ends of its own steps, with its inputs at the beginnings") {
  TwoRates f(100ms);
  CHECK(points(f, 0.2, 20ms).size() == 11);
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0", "0.1-0.2: 0.1"});
  CHECK(steps_of(f.fast) == Calls{"0-0.02: 0", "0.02-0.04: 0", "0.04-0.06: 0", "0.06-0.08: 0",
                                  "0.08-0.1: 0", "0.1-0.12: 0.1", "0.12-0.14: 0.1",
                                  "0.14-0.16: 0.1", "0.16-0.18: 0.1", "0.18-0.2: 0.1"});
  CHECK(f.simulation->statistics().units[1].steps == 2);
}

TEST_CASE("communication points are those of all grids") {
  TwoRates f(30ms);
  f.declaration.components[0].own_step = 20ms;
  CHECK(points(f, 0.06, 20ms) == std::vector<Time>{at(0), at(0.02), at(0.03), at(0.04), at(0.06)});
  CHECK(steps_of(f.fast) == Calls{"0-0.02: 0", "0.02-0.04: 0", "0.04-0.06: 0.03"});
  CHECK(steps_of(f.slow) == Calls{"0-0.03: 0", "0.03-0.06: 0.02"});
}

TEST_CASE("a finer grid than that of the others ends their steps, too") {
  TwoRates f(5ms);
  CHECK(points(f, 0.02, 10ms).size() == 5);
  CHECK(steps_of(f.fast).size() == 4);
}

TEST_CASE("two units of one step size each, and an event of a third one") {
  TwoRates f(100ms, io_unit().fixed_step(), io_unit().fixed_step());
  f.declaration.components[0].own_step = 20ms;
  auto& third = f.add("third", io_unit().event_mode().may_return_early().done());
  third.on_step = [](ScriptedUnit&, Time from, Time to) {
    StepResult result = reached(from < at(0.033) && at(0.033) < to ? at(0.033) : to);
    result.early_return = result.event_handling_needed = result.reached != to;
    return result;
  };
  const auto times = points(f, 0.1, 20ms);
  CHECK(times ==
        std::vector<Time>{at(0), at(0.02), at(0.033), at(0.04), at(0.06), at(0.08), at(0.1)});
  CHECK(steps_of(f.fast).size() == 5);
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0"});
}

TEST_CASE("a step is cut at the unit's own event, and at the stop time") {
  TwoRates f(100ms, io_unit(), io_unit().event_mode());
  bool has_announced = false;
  f.slow.on_event = [&](ScriptedUnit&) {
    EventResult result;
    if (!std::exchange(has_announced, true)) result.next_event_time = at(0.13);
    return result;
  };
  f.build(0.25, 20ms).run();
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0", "0.1-0.13: 0.1", "0.13-0.2: 0.13", "0.2-0.25: 0.2"});
}

TEST_CASE("a unit of one step size is not called for the rest up to the stop time") {
  TwoRates f(100ms, io_unit(), io_unit().fixed_step());
  f.build(0.25, 20ms).run();
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0", "0.1-0.2: 0.1"});
}

TEST_CASE("an event of a unit of one step size between its points is an error") {
  TwoRates f(100ms, io_unit(), io_unit().fixed_step().event_mode());
  f.slow.on_event = [&](ScriptedUnit&) { return EventResult{false, false, at(0.13)}; };
  CHECK_THAT(failure(f.build(0.25, 20ms)),
             Contains("'slow', at 0.13 s: the unit takes steps of one size only, 0.1 s, and its "
                      "present one ends at 0.2 s"));
}

TEST_CASE("a message ends the step of its receiver, or waits for its end") {
  const bool can_vary = GENERATE(true, false);
  ScriptedSystem f;
  auto& sender = f.add("sender", message_system().done());
  auto receives = Describe("receiver")
                      .add("clock", ValueType::Clock, Causality::Input)
                      .add("value", ValueType::Float64, Causality::Input)
                      .clocked_by(0)
                      .never_rejects();
  auto& receiver = f.add("receiver", (can_vary ? receives : receives.fixed_step()).done());
  f.declaration.components[1].own_step = 100ms;
  f.wire("sender", "clock", "receiver", "clock");
  f.wire("sender", "value", "receiver", "value");
  Time now{}, received{};
  sender.on_step = [&](ScriptedUnit& unit, Time, Time to) {
    StepResult result = reached(now = to);
    result.event_handling_needed = to == at(0.04);
    unit.clock(0) = to == at(0.04);
    return result;
  };
  sender.on_event = [](ScriptedUnit& unit) { return unit.clock(0) = false, EventResult{}; };
  receiver.on_step = [](ScriptedUnit& unit, Time from, Time to) {
    unit.calls.push_back(fmt::format("{}-{}:", to_text(from), to_text(to)));
    return reached(to);
  };
  receiver.on_set_clock = [&](ScriptedUnit&) { received = now; };
  f.build(0.2, 20ms).run();
  CHECK(received == (can_vary ? at(0.04) : at(0.1)));
  CHECK(steps_of(receiver) ==
        (can_vary ? Calls{"0-0.04:", "0.04-0.1:", "0.1-0.2:"} : Calls{"0-0.1:", "0.1-0.2:"}));
}

TEST_CASE("what another unit rejects in the same interval does not concern its steps") {
  TwoRates f(100ms, Describe("rejecter").input("u").output("y").can_save_state());
  f.add("other", Describe("other").input("u").output("y").can_save_state().done());
  f.fast.on_step = [](ScriptedUnit& unit, Time from, Time to) {
    StepResult result = reached(to);
    result.rejected = to - from > 10ms;
    if (!result.rejected) unit.number(1) = to_seconds(to);
    return result;
  };
  f.build(0.2, 20ms).run();
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0", "0.1-0.2: 0.1"});
  CHECK(f.simulation->statistics().units[2].rollbacks > 0);
}

TEST_CASE("a step that the unit rejects is made in parts") {
  TwoRates f(100ms);
  f.slow.on_step = [](ScriptedUnit& unit, Time from, Time to) {
    StepResult result = noting()(unit, from, to);
    result.rejected = to - from > 60ms;
    return result;
  };
  f.build(0.1, 20ms).run();
  CHECK(steps_of(f.slow) == Calls{"0-0.1: 0", "0-0.05: 0", "0.05-0.1: 0"});
  const UnitStatistics& counts = f.simulation->statistics().units[1];
  CHECK(counts.steps == 2);
  CHECK(counts.rejections == 1);
}

TEST_CASE("a step of the only size that the unit rejects is an error") {
  TwoRates f(100ms, io_unit(), io_unit().fixed_step());
  f.slow.on_step = [](ScriptedUnit&, Time, Time) {
    StepResult result;
    result.rejected = true;
    return result;
  };
  CHECK_THAT(failure(f.build(0.2, 20ms)), Contains("'slow', at 0 s: the unit rejected its step") &&
                                              Contains("0.1 s, so no shorter"));
}

TEST_CASE("what may return early is called at each point, and its own step is its longest") {
  TwoRates f(50ms, io_unit(), io_unit().event_mode().may_return_early());
  f.build(0.1, 40ms).run();
  CHECK(steps_of(f.slow) ==
        Calls{"0-0.04: 0", "0.04-0.05: 0.04", "0.05-0.08: 0.05", "0.08-0.1: 0.08"});
}

TEST_CASE("outputs of a component with its own step are extrapolated from its own points") {
  TwoRates f(100ms);
  f.declaration.connections.erase(f.declaration.connections.begin());
  f.options.extrapolation = Extrapolation::Linear;
  f.build(0.3, 50ms).run();
  CHECK(steps_of(f.fast)[4] == "0.2-0.25: 0.225");
  CHECK(steps_of(f.fast)[5] == "0.25-0.3: 0.275");
}

TEST_CASE("inputs that are extrapolated are those that are known at the end of the step") {
  TwoRates f(100ms);
  f.options.extrapolation = Extrapolation::Linear;
  f.build(0.2, 50ms).run();
  CHECK(steps_of(f.slow)[1] == "0.1-0.2: 0.15");
}

TEST_CASE("a run from event to event, and a controlled error, have own steps, too") {
  TwoRates f(100ms, io_unit().can_save_state(), io_unit().can_save_state());
  const bool controls = GENERATE(true, false);
  f.options.step.policy = controls ? &kErrorControlledSteps : &kEventDrivenSteps;
  f.build(0.2, 20ms).run();
  CHECK(f.slow.calls.size() >= 2);
  CHECK(steps_of(f.slow).front() == "0-0.1: 0");
  CHECK(f.simulation->statistics().units[1].steps >= 2);
}

TEST_CASE("an intervention goes on from its instant") {
  TwoRates f(100ms);
  ValueBlock value(ValueType::Float64, 1);
  value.numbers<double>()[0] = 7;
  Intervention force;
  force.kind = Intervention::Kind::Force;
  force.id = {1, 0};
  force.value = value;
  force.from = at(0.04);
  f.options.interventions = {force};
  f.build(0.2, 20ms).run();
  CHECK(steps_of(f.slow) == Calls{"0-0.04: 0", "0.04-0.1: 7", "0.1-0.2: 7"});
}

TEST_CASE("idle units let the run go on to the end of an own step") {
  TwoRates f(100ms, io_unit().promises_idle());
  f.declaration.connections.clear();
  f.fast.on_idle_until = [](ScriptedUnit&) { return Time::max(); };
  f.options.idle.max_skip = {Duration::max(), Duration::max()};
  f.options.idle.least = 10ms;
  CHECK(points(f, 0.3, 10ms) == std::vector<Time>{at(0), at(0.1), at(0.2), at(0.3)});
  CHECK(steps_of(f.slow).size() == 3);
}

TEST_CASE("stretches of regular steps pass the ends of own steps") {
  const bool in_stretches = GENERATE(true, false);
  TwoRates f(100ms);
  f.options.steps_in_stretches = in_stretches;
  f.options.measure_time = false;
  CHECK(points(f, 1, 20ms).size() == 51);
  CHECK(steps_of(f.slow)[9] == "0.9-1: 0.9");
  CHECK(steps_of(f.fast)[49] == "0.98-1: 0.9");
}
