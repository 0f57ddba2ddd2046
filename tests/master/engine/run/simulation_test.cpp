#include "master/engine/run/simulation.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "master/base/text/hex.h"
#include "master/base/time_text.h"
#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

using Fixture = ScriptedSystem;

auto one_in_one_out() { return Describe("io").input("u").output("y").done(); }

auto messenger() {
  return Describe("messenger")
      .add("in.clock", ValueType::Clock, Causality::Input)
      .add("in", ValueType::Binary, Causality::Input)
      .clocked_by(0)
      .add("out.clock", ValueType::Clock, Causality::Output)
      .add("out", ValueType::Binary, Causality::Output)
      .clocked_by(2)
      .done();
}

struct Seen : Observer {
  std::vector<std::string> messages;
  std::vector<Time> points;
  std::vector<double> values;
  Signal signal{};
  std::size_t count = 0;
  int finished = 0;
  void on_start(std::span<const Signal> signals) override {
    count = signals.size();
    if (!signals.empty()) signal = signals[0];
  }
  void on_message(const Message& message) override {
    messages.push_back(to_text(message.time) + "/" + std::to_string(message.index) +
                       (message.received ? " received " : " sent ") +
                       std::to_string(message.id.component) + ":" +
                       to_hex(message.block->binaries()[0]));
  }
  void on_communication_point(Time time) override {
    points.push_back(time);
    if (signal.block != nullptr) values.push_back(signal.block->numbers<double>()[signal.first]);
  }
  void on_finish() override { ++finished; }
};

}  // namespace

TEST_CASE("a start value of an element leaves the others of its array to the unit") {
  Fixture f;
  ScriptedUnit& unit = f.add("a", Describe("array").input("u").size(3).done());
  for (std::size_t i = 0; i < 3; ++i) set_real(unit.block(0), i, 10.0 * static_cast<double>(i));
  unit.on_initialize = [&](ScriptedUnit& self) {
    CHECK(self.block(0) ==
          parse(*f.system->components()[0].description->variables.begin(), "0 7 20"));
  };
  f.declaration.start_values = {{"a", "u[2]", "7", {}, {}}};
  f.build(0.1, 100ms).run();
}

TEST_CASE("a million steps of 1/3 ms end exactly, and every unit gets exact times") {
  Fixture f;
  Time expected{};
  std::uint64_t wrong = 0;
  f.add("a", one_in_one_out()).on_step = [&](ScriptedUnit&, Time from, Time to) {
    wrong += from != expected;
    expected = to;
    StepResult result;
    result.reached = to;
    return result;
  };
  const Duration third = Duration(333'333'333);
  f.build(333.5, third).run();
  CHECK(wrong == 0);
  CHECK(expected == time_from_seconds(333.5));
  CHECK(f.simulation->statistics().communication_steps == 1'000'501);
  CHECK(f.simulation->statistics().reached == time_from_seconds(333.5));
}

TEST_CASE("Jacobi: each unit sees the others' outputs of the last communication point") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  a.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 1; };
  b.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 10; };
  const auto step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(1) = unit.number(0) + 1;
    StepResult result;
    result.reached = to;
    return result;
  };
  a.on_step = b.on_step = step;
  f.build(0.003, 1ms).run();
  // a: 11, 3, 13; b: 2, 12, 4
  CHECK(a.number(1) == 13);
  CHECK(b.number(1) == 4);
}

TEST_CASE("initial values run through a chain without delay, whatever the order of the units") {
  Fixture f;
  auto& c = f.add("c", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  auto& a = f.add("a", one_in_one_out());
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "c", "u");
  a.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 5; };
  b.on_initialize =
      c.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 2 * unit.number(0); };
  Seen seen;
  f.build(0.001, 1ms, {{0, 1}}).add_observer(seen);
  f.simulation->run();
  REQUIRE(seen.values.size() == 2);
  CHECK(seen.values[0] == 20);
}

TEST_CASE("an algebraic loop without a solution is an error") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  a.on_initialize =
      b.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = unit.number(0) + 1; };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("algebraic loop a.u -> a.y -> b.u -> b.y -> a.u"));
}

TEST_CASE("values are converted between units of measurement") {
  Fixture f;
  const BaseUnitOfMeasure metre{{0, 1}, 1, 0};
  const BaseUnitOfMeasure millimetre{{0, 1}, 1e-3, 0};
  auto& a = f.add("a", Describe("a").unit("mm", millimetre).output("y", "mm").done());
  auto& b = f.add("b", Describe("b").unit("m", metre).input("u", "m").done());
  f.wire("a", "y", "b", "u");
  a.on_initialize = [](ScriptedUnit& unit) { unit.number(0) = 250; };
  f.build(0.001, 1ms).run();
  CHECK(b.number(0) == Approx(0.25));
}

TEST_CASE("all types are exchanged") {
  const auto type =
      GENERATE(ValueType::Float32, ValueType::Int8, ValueType::UInt16, ValueType::Int32,
               ValueType::UInt64, ValueType::Boolean, ValueType::String, ValueType::Enumeration);
  Fixture f;
  auto& a = f.add("a", Describe("a").add("y", type, Causality::Output).size(2).done());
  auto& b = f.add("b", Describe("b").add("u", type, Causality::Input).size(2).done());
  f.wire("a", "y", "b", "u");
  Variable pair = make_variable("y", 0, type, Causality::Output);
  pair.size = 2;
  pair.items = {{"0", 0}, {"1", 1}};
  a.on_initialize = [&](ScriptedUnit& unit) { unit.block(0) = parse(pair, "0 1"); };
  f.build(0.001, 1ms).run();
  CHECK(element_text(b.block(0), 0) == element_text(a.block(0), 0));
  CHECK(element_text(b.block(0), 1) == element_text(a.block(0), 1));
  CHECK(element_text(b.block(0), 0) != element_text(b.block(0), 1));
}

TEST_CASE("messages are handed over at communication points until nothing ticks") {
  Fixture f;
  auto& a = f.add("a", messenger());
  auto& b = f.add("b", messenger());
  f.wire("a", "out", "b", "in");
  f.wire("a", "out.clock", "b", "in.clock");
  f.wire("b", "out", "a", "in");
  f.wire("b", "out.clock", "a", "in.clock");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    StepResult result;
    result.reached = to;
    if (to == time_from_seconds(0.002)) {
      unit.clock(2) = true;
      unit.binary(3) = {0xAB};
      result.event_handling_needed = true;
    }
    return result;
  };
  a.on_event = [](ScriptedUnit& unit) {
    unit.clock(2) = false;
    return EventResult{};
  };
  b.on_event = [](ScriptedUnit& unit) {  // answers each message with its complement, at once
    EventResult result;
    result.discrete_states_need_update = unit.clock(2) = unit.clock(0);
    if (unit.clock(0)) unit.binary(3) = {static_cast<std::uint8_t>(~unit.binary(1)[0])};
    return result;
  };
  Seen seen;
  f.build(0.004, 1ms).add_observer(seen);
  f.simulation->run();
  const std::vector<std::string> expected = {"0.002/0 sent 0:ab", "0.002/0 received 1:ab",
                                             "0.002/1 sent 1:54", "0.002/1 received 0:54"};
  CHECK(seen.messages == expected);
  CHECK(f.simulation->statistics().units[0].messages_sent == 1);
  CHECK(f.simulation->statistics().units[0].messages_received == 1);
}

TEST_CASE("a value of two clocks travels to those whose clock ticks") {
  Fixture f;
  auto sender =
      std::make_shared<UnitDescription>(*Describe("sender")
                                             .add("first", ValueType::Clock, Causality::Output)
                                             .add("second", ValueType::Clock, Causality::Output)
                                             .add("out", ValueType::Binary, Causality::Output)
                                             .clocked_by(0)
                                             .done());
  sender->variables[2].clocks = {0, 1};
  auto& a = f.add("a", sender);
  const std::vector<ScriptedUnit*> receivers = {&f.add("b", messenger()), &f.add("c", messenger())};
  f.wire("a", "first", "b", "in.clock");
  f.wire("a", "second", "c", "in.clock");
  f.wire("a", "out", "b", "in");
  f.wire("a", "out", "c", "in");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    StepResult result = reached(to);
    unit.clock(0) = to == Time(1ms);
    unit.clock(1) = to == Time(2ms);
    unit.binary(2) = {static_cast<std::uint8_t>(to.time_since_epoch() / 1ms)};
    result.event_handling_needed = true;
    return result;
  };
  Seen seen;
  f.build(0.002, 1ms).add_observer(seen);
  f.simulation->run();
  CHECK(seen.messages == std::vector<std::string>{"0.001/0 sent 0:01", "0.001/0 received 1:01",
                                                  "0.002/0 sent 0:02", "0.002/0 received 2:02"});
  CHECK(receivers[0]->binary(1) == Binary{1});
  CHECK(receivers[1]->binary(1) == Binary{2});
}

TEST_CASE("a unit without events is never in Event Mode after the start") {
  Fixture f;
  auto& a = f.add("a", messenger());
  f.build(0.003, 1ms).run();
  const ScriptedUnit::Calls expected = {"enter_initialization", "exit_initialization",
                                        "update_discrete_states", "enter_step_mode", "terminate"};
  CHECK(a.calls == expected);
}

TEST_CASE("a unit's next event time is a communication point") {
  Fixture f;
  auto& a = f.add("a", messenger());
  std::vector<Time> events;
  Time now{};
  a.on_step = [&](ScriptedUnit&, Time, Time to) {
    now = to;
    return reached(to);
  };
  a.on_event = [&](ScriptedUnit&) {
    events.push_back(now);
    EventResult result;
    if (now == Time{}) result.next_event_time = time_from_seconds(0.0015);
    return result;
  };
  Seen seen;
  f.build(0.003, 1ms).add_observer(seen);
  f.simulation->run();
  CHECK(events == std::vector<Time>{Time{}, time_from_seconds(0.0015)});
  const std::vector<Time> points = {Time{}, Time(1ms), time_from_seconds(0.0015), Time(2ms),
                                    Time(3ms)};
  CHECK(seen.points == points);
}

TEST_CASE("a clock that ticks because another one was set is transmitted in the same instant") {
  Fixture f;
  auto& source = f.add("z_source", messenger());
  auto& echo = f.add("echo", messenger());
  f.declaration.components.front().name = "source";
  auto& sink = f.add("sink", messenger());
  f.wire("source", "out", "echo", "in");
  f.wire("source", "out.clock", "echo", "in.clock");
  f.wire("echo", "out", "sink", "in");
  f.wire("echo", "out.clock", "sink", "in.clock");
  bool sent = false;
  source.on_event = [&](ScriptedUnit& unit) {
    EventResult result;
    unit.clock(2) = result.discrete_states_need_update = !sent;
    if (!sent) unit.binary(3) = {0x11};
    sent = true;
    return result;
  };
  // as another tool's unit: its output clock follows its input clock before
  // fmi3UpdateDiscreteStates
  echo.on_set_clock = [](ScriptedUnit& unit) {
    unit.clock(2) = true;
    unit.binary(3) = {0x22};
  };
  echo.on_event = [](ScriptedUnit& unit) {
    unit.clock(2) = false;
    return EventResult{};
  };
  std::vector<std::uint8_t> heard;
  sink.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(0)) heard.push_back(unit.binary(1)[0]);
    return EventResult{};
  };
  Seen seen;
  f.build(0.001, 1ms).add_observer(seen);
  f.simulation->run();
  CHECK(heard == std::vector<std::uint8_t>{0x22});
  CHECK(seen.messages == std::vector<std::string>{"0/1 sent 0:11", "0/1 received 1:11",
                                                  "0/1 sent 1:22", "0/1 received 2:22"});
}

TEST_CASE("a discrete input that changes is set in Event Mode") {
  Fixture f;
  auto& a = f.add("a", Describe("a").add("y", ValueType::Boolean, Causality::Output).done());
  auto& b =
      f.add("b", Describe("b").add("u", ValueType::Boolean, Causality::Input).event_mode().done());
  f.wire("a", "y", "b", "u");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.clock(0) = to >= time_from_seconds(0.003);
    return reached(to);
  };
  std::vector<bool> seen_in_events;
  b.on_event = [&](ScriptedUnit& unit) {
    seen_in_events.push_back(unit.clock(0));
    return EventResult{};
  };
  f.build(0.006, 1ms).run();
  CHECK(seen_in_events == std::vector<bool>{false, true});
}

TEST_CASE("what an event changes reaches another unit's event in the same instant") {
  Fixture f;
  const auto relay = Describe("relay")
                         .add("u", ValueType::Int32, Causality::Input)
                         .add("y", ValueType::Int32, Causality::Output)
                         .event_mode()
                         .done();
  const auto forward = [](ScriptedUnit& unit) {
    unit.block(1).numbers<std::int32_t>()[0] = unit.block(0).numbers<std::int32_t>()[0] + 1;
    return EventResult{};
  };
  auto& c = f.add("c", relay);
  auto& b = f.add("b", relay);
  auto& a = f.add("a", relay);
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "c", "u");
  a.on_event = b.on_event = c.on_event = forward;
  f.build(0, 1ms).run();
  CHECK(c.block(1).numbers<std::int32_t>()[0] == 3);
}

TEST_CASE("units that tick for ever are named") {
  Fixture f;
  f.add("quiet", messenger());
  auto& a = f.add("restless", messenger());
  a.on_event = [](ScriptedUnit&) {
    EventResult result;
    result.discrete_states_need_update = true;
    return result;
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("'restless'") && !Contains("quiet"));
}

TEST_CASE("a connected output that is NaN ends the run with the name of its unit") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  f.add("b", one_in_one_out());
  f.wire("a", "y", "b", "u");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    if (to == time_from_seconds(0.003)) unit.number(1) = std::numeric_limits<double>::quiet_NaN();
    StepResult result;
    result.reached = to;
    return result;
  };
  Seen seen;
  f.build(1, 1ms).add_observer(seen);
  CHECK_THAT(failure(*f.simulation),
             Contains("unit 'a', variable 'y', at 0.003 s") && Contains("NaN"));
  CHECK(seen.points.size() == 3);
  CHECK(seen.finished == 1);
  CHECK(f.simulation->statistics().reached == time_from_seconds(0.002));
}

TEST_CASE("a chain may pass through one unit several times") {
  Fixture f;
  const auto ports = Describe("ports")
                         .input("u0")
                         .input("u1")
                         .input("u2")
                         .output("y0")
                         .output("y1")
                         .output("y2")
                         .done();
  auto& a = f.add("a", ports);
  auto& b = f.add("b", ports);
  f.wire("a", "y0", "b", "u0");
  f.wire("b", "y0", "a", "u1");
  f.wire("a", "y1", "b", "u1");
  f.wire("b", "y1", "a", "u2");
  f.wire("a", "y2", "b", "u2");
  const auto through = [](ScriptedUnit& unit) {
    for (ValueReference port = 0; port < 3; ++port) unit.number(port + 3) = unit.number(port) + 1;
  };
  a.on_initialize = b.on_initialize = through;
  f.build(0.001, 1ms).run();
  CHECK(b.number(5) == 6);
}

TEST_CASE("an output beyond the range of the input that it is connected to ends the run") {
  const bool is_float = GENERATE(true, false);
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  f.add("b", Describe("b").add("u", ValueType::Float32, Causality::Input).done());
  f.add("c", one_in_one_out());
  f.wire("a", "y", is_float ? "b" : "c", "u");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(1) = to < time_from_seconds(0.003) ? 3e38 : -1e39;
    StepResult result;
    result.reached = to;
    return result;
  };
  const std::string result = failure(f.build(1, 1ms));
  if (is_float) {
    CHECK_THAT(result, Contains("unit 'a', variable 'y', at 0.003 s: the output is -1e+39, which "
                                "is beyond the range of Float32"));
  } else {
    CHECK(result == "none");
  }
}

TEST_CASE("a number that a Float32 has not, so near to 0, is a warning, once for the output") {
  Fixture f;
  auto& a = f.add("a", Describe("a").output("y").size(2).output("z").done());
  f.add("b", Describe("b")
                 .add("u", ValueType::Float32, Causality::Input)
                 .size(2)
                 .add("v", ValueType::Float32, Causality::Input)
                 .input("w")
                 .done());
  f.wire("a", "y", "b", "u");
  f.wire("a", "z", "b", "v");
  f.wire("a", "z", "b", "w");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.block(0).numbers<double>()[0] = unit.block(0).numbers<double>()[1] = 1e-50;
    unit.block(1).numbers<double>()[0] = 1e-40;  // with fewer digits than others
    return reached(to);
  };
  std::vector<std::string> warnings;
  f.options.warn = [&](const std::string& text) { warnings.push_back(text); };
  f.build(0.005, 1ms).run();
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Contains("unit 'a', variable 'y', at 0.001 s: the output is 1e-50, which becomes 0 in "
                      "the input that it is connected to: Float32 has no such number"));
}

TEST_CASE("NaN is looked for once the initial values have arrived") {
  Fixture f;
  auto& root = f.add("root", one_in_one_out());
  auto& sink = f.add("sink", one_in_one_out());
  auto& five = f.add("five", one_in_one_out());
  f.wire("five", "y", "root", "u");
  f.wire("root", "y", "sink", "u");
  five.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 5; };
  root.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = std::sqrt(unit.number(0) - 1); };
  f.build(0, 1ms).run();
  CHECK(sink.number(0) == 2);
}

TEST_CASE("a step size near the end of time does not overflow") {
  Fixture f;
  f.add("a", one_in_one_out());
  Seen seen;
  f.build(9e6, duration_from_seconds(5e6)).add_observer(seen);
  f.simulation->run();
  CHECK(seen.points == std::vector<Time>{Time{}, time_from_seconds(5e6), time_from_seconds(9e6)});
}

TEST_CASE("a unit can end the simulation") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  a.on_step = [](ScriptedUnit&, Time, Time to) {
    StepResult result;
    result.reached = to;
    result.terminate_simulation = to == time_from_seconds(0.003);
    return result;
  };
  f.build(1, 1ms).run();
  CHECK(f.simulation->statistics().reached == time_from_seconds(0.003));
  CHECK(f.simulation->statistics().end == RunEnd::EndedByUnit);
  CHECK(a.calls.back() == "terminate");
}

TEST_CASE("a unit that ends the simulation where its step begins leaves no second row there") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  a.on_step = [](ScriptedUnit&, Time from, Time to) {
    const bool ends = from == time_from_seconds(0.002);
    return StepResult{
        .early_return = ends, .terminate_simulation = ends, .reached = ends ? from : to};
  };
  Seen seen;
  f.build(1, 1ms).add_observer(seen);
  f.simulation->run();
  CHECK(seen.points ==
        std::vector<Time>{Time{}, time_from_seconds(0.001), time_from_seconds(0.002)});
  CHECK(f.simulation->statistics().end == RunEnd::EndedByUnit);
}

TEST_CASE("a unit that cannot be terminated, or has failed, keeps no other from it") {
  const bool fails_in_step = GENERATE(true, false);
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  a.on_terminate = [](ScriptedUnit&) { fail_run({.unit = "a"}, "it does not end"); };
  a.on_step = [&](ScriptedUnit&, Time, Time to) {
    if (fails_in_step) fail_run({.unit = "a"}, "no");
    return reached(to);
  };
  CHECK_THAT(failure(f.build(0.002, 1ms)), Contains(fails_in_step ? "no" : "it does not end"));
  CHECK(b.calls.back() == "terminate");
}

TEST_CASE("no unit is terminated before the initialisation is complete") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  b.on_initialize = [](ScriptedUnit&) { fail_run({.unit = "b"}, "no"); };
  CHECK_THAT(failure(f.build(0.002, 1ms)), Contains("no"));
  CHECK(std::ranges::count(a.calls, "terminate") == 0);
}

TEST_CASE("the units are freed when all are terminated, and a failure there is one of the run") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  bool is_b_terminated = false;
  a.on_free = [&](ScriptedUnit&) { is_b_terminated = b.calls.back() == "terminate"; };
  b.on_free = [](ScriptedUnit&) { fail_run({.unit = "b"}, "it cannot be freed"); };
  Seen seen;
  f.build(0.002, 1ms).add_observer(seen);
  CHECK_THROWS_WITH(f.simulation->run(), Contains("unit 'b': it cannot be freed"));
  CHECK(is_b_terminated);
  CHECK(seen.finished == 1);
  CHECK(f.simulation->statistics().reached == time_from_seconds(0.002));
}

TEST_CASE("units of a run that has failed are not freed by it") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  bool is_freed = false;
  a.on_free = [&](ScriptedUnit&) { is_freed = true; };
  a.on_step = [](ScriptedUnit&, Time, Time) -> StepResult { fail_run({.unit = "a"}, "no"); };
  CHECK_THROWS_AS(f.build(1, 1ms).run(), Error);
  CHECK_FALSE(is_freed);
}

TEST_CASE("the diagnostics of a host are in the statistics, also if the run fails") {
  const bool fails = GENERATE(false, true);
  Fixture f;
  f.add("in_process", one_in_one_out());
  f.add("hosted", one_in_one_out()).on_step = [&](ScriptedUnit& unit, Time, Time to) {
    unit.host =
        HostStatistics{.most_memory = 7 * static_cast<std::uint64_t>(to_seconds(to) * 1000)};
    if (fails && to == time_from_seconds(0.002)) fail_run({}, "the process ended");
    return reached(to);
  };
  f.build(0.003, 1ms);
  CHECK_THAT(failure(*f.simulation), Contains(fails ? "the process ended" : "none"));
  const auto& units = f.simulation->statistics().units;
  CHECK_FALSE(units[0].host);
  CHECK(units[1].host.value().most_memory == (fails ? 14 : 21));
}

TEST_CASE("an input is recorded as its source left it") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  f.add("b", one_in_one_out());
  f.wire("a", "y", "b", "u");
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(1) = to_seconds(to);
    StepResult result;
    result.reached = to;
    return result;
  };
  Seen seen;
  f.build(0.002, 1ms, {{1, 0}}).add_observer(seen);
  f.simulation->run();
  CHECK(seen.values == std::vector<double>{0, 0.001, 0.002});
}

TEST_CASE("an observer sees the signals that it requests, and no other observer does") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(0) = 7;
    unit.number(1) = to_seconds(to);
    return reached(to);
  };
  f.options.watched = {{0, 0}, {0, 1}};
  Seen recorder;
  Seen other;
  f.build(0.002, 1ms, {{0, 1}}).add_observer(recorder);
  f.simulation->add_observer(other, {{0, 0}});
  CHECK_THROWS_WITH(f.simulation->add_observer(other, {{0, 2}}), Contains("not read"));
  f.simulation->run();
  CHECK(recorder.count == 1);
  CHECK(recorder.values == std::vector<double>{0, 0.001, 0.002});
  CHECK(other.count == 1);
  CHECK(other.values == std::vector<double>{0, 7, 7});
}

TEST_CASE("every observer is finished although one of them fails") {
  struct Failing : Observer {
    void on_finish() override { fail_run({}, "disk full"); }
  };
  Fixture f;
  f.add("a", one_in_one_out());
  Failing failing;
  Seen seen;
  f.build(0.001, 1ms).add_observer(failing);
  f.simulation->add_observer(seen);
  CHECK_THAT(failure(*f.simulation), Contains("disk full"));
  CHECK(seen.finished == 1);
}

namespace {

/// Notes when the unit has its events; each announces the next one.
struct Announcer : ScriptedSystem {
  ScriptedUnit& unit = add("a", Describe("a").event_mode().done());
  Time now{};
  std::vector<Time> events;

  void announce(std::function<std::optional<Time>(std::size_t event)> next) {
    unit.on_step = [this](ScriptedUnit&, Time, Time to) { return reached(now = to); };
    unit.on_event = [this, next](ScriptedUnit&) {
      events.push_back(now);
      EventResult result;
      result.next_event_time = next(events.size());
      return result;
    };
  }
};

using stride::tests::at;

}  // namespace

TEST_CASE("an event that is announced for now is another event iteration") {
  Announcer f;
  f.announce([](std::size_t event) -> std::optional<Time> {
    if (event == 1) return Time{};
    if (event <= 3) return at(0.0025);
    return std::nullopt;
  });
  f.build(0.004, 1ms).run();
  CHECK(f.events == std::vector<Time>{at(0), at(0), at(0.0025), at(0.0025)});
}

TEST_CASE("a unit whose next event is always past is named") {
  Announcer f;
  f.announce([](std::size_t) { return at(0.0005); });
  CHECK_THROWS_WITH(f.build(0.004, 1ms).run(),
                    Contains("0.0005 s") && Contains("'a'") && Contains("not later than now"));
}

TEST_CASE("a unit that ends the simulation in an event has no further event iteration") {
  Announcer f;
  f.announce([](std::size_t) { return std::nullopt; });
  f.unit.on_event = [&](ScriptedUnit&) {
    f.events.push_back(f.now);
    return EventResult{.discrete_states_need_update = true,
                       .terminate_simulation = f.events.size() == 3,
                       .next_event_time = {}};
  };
  f.build(1, 1ms).run();
  CHECK(f.events.size() == 3);
  CHECK(f.simulation->statistics().end == RunEnd::EndedByUnit);
  // Step Mode would ask for the update that is pending
  CHECK(std::ranges::count(f.unit.calls, "enter_step_mode") == 0);
  CHECK(f.unit.calls.back() == "terminate");
}

TEST_CASE("NaN in a message is an error") {
  ScriptedSystem f;
  const auto message = [](Causality causality) {
    Describe description("m");
    description.add("c", ValueType::Clock, causality);
    causality == Causality::Output ? description.output("p") : description.input("p");
    return description.clocked_by(0).event_mode().done();
  };
  auto& a = f.add("a", message(Causality::Output));
  f.add("b", message(Causality::Input));
  f.wire("a", "c", "b", "c");
  f.wire("a", "p", "b", "p");
  a.on_initialize = [](ScriptedUnit& unit) {
    unit.clock(0) = true;
    unit.number(1) = std::nan("");
  };
  CHECK_THROWS_WITH(f.build(1, 1ms).run(), Contains("unit 'a', variable 'p'") && Contains("NaN"));
}

TEST_CASE("a simulation runs once") {
  ScriptedSystem f;
  f.add("a", Describe("a").done());
  f.build(0.004, 1ms).run();
  CHECK_THROWS_AS(f.simulation->run(), std::logic_error);
}

namespace {

/// Two messengers, of which `a` sends AB at 2 ms.
struct OneMessage : Fixture {
  ScriptedUnit& a = add("a", messenger());
  ScriptedUnit& b = add("b", messenger());

  OneMessage() {
    wire("a", "out", "b", "in");
    wire("a", "out.clock", "b", "in.clock");
    a.on_step = [](ScriptedUnit& unit, Time, Time to) {
      StepResult result;
      result.reached = to;
      result.event_handling_needed = unit.clock(2) = to == time_from_seconds(0.002);
      unit.binary(3) = {0xAB};
      return result;
    };
    a.on_event = [](ScriptedUnit& unit) {
      unit.clock(2) = false;
      return EventResult{};
    };
    a.on_describe = [](ScriptedUnit&, ValueReference variable, const Binary& value) {
      return fmt::format("{} in {}", to_hex(value), variable);
    };
  }
  static bool was_asked(const ScriptedUnit& unit) {
    return std::ranges::count(unit.calls, "describe_message") > 0;
  }
};

struct Listener : Observer {
  std::vector<std::string> contents;
  bool wants_content() const override { return true; }
  void on_message(const Message& message) override { contents.emplace_back(message.content); }
};

}  // namespace

TEST_CASE("a message has its content where an observer requires it") {
  OneMessage f;
  f.b.on_describe = [](ScriptedUnit&, ValueReference, const Binary&) {
    return std::string("heard\n\xFF") + std::string(1000, '!');
  };
  Listener listener;
  Seen seen;
  f.build(0.004, 1ms).add_observer(seen);
  f.simulation->add_observer(listener);
  f.simulation->run();
  REQUIRE(listener.contents.size() == 2);
  CHECK(listener.contents[0] == "ab in 3");
  CHECK(listener.contents[1] == "heard \uFFFD" + std::string(kLongestContent - 8, '!') + "…");
}

TEST_CASE("a unit without text for a message takes that of the other end") {
  OneMessage f;
  const auto words = f.a.on_describe;
  const auto none = f.b.on_describe;
  const bool sender_knows = GENERATE(true, false);
  f.a.on_describe = sender_knows ? words : none;
  f.b.on_describe = sender_knows ? none : words;
  Listener listener;
  f.build(0.004, 1ms).add_observer(listener);
  f.simulation->run();
  const std::string expected = sender_knows ? "ab in 3" : "ab in 1";
  CHECK(listener.contents == std::vector<std::string>{expected, expected});
}

TEST_CASE("no message is described where no observer needs its content") {
  OneMessage f;
  Seen seen;
  f.build(0.004, 1ms).add_observer(seen);
  f.simulation->run();
  CHECK(seen.messages.size() == 2);
  CHECK_FALSE(OneMessage::was_asked(f.a));
  CHECK_FALSE(OneMessage::was_asked(f.b));
}
