#include "master/core/simulation.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "scripted_unit.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

/// Two units a and b, wired as the test says; the instances stay reachable while the simulation
/// owns them.
struct Fixture {
  SystemDeclaration declaration;
  std::vector<ScriptedUnit*> instances;
  std::vector<std::unique_ptr<Unit>> units;
  std::unique_ptr<System> system;
  std::unique_ptr<Simulation> simulation;

  ScriptedUnit& add(const std::string& name, std::shared_ptr<const UnitDescription> description) {
    declaration.components.push_back({name, description, {}, {}});
    auto unit = std::make_unique<ScriptedUnit>(description);
    instances.push_back(unit.get());
    units.push_back(std::move(unit));
    return *instances.back();
  }
  void wire(const std::string& from, const std::string& from_connector, const std::string& to,
            const std::string& to_connector) {
    declaration.connections.push_back({from, from_connector, to, to_connector, false, {}});
  }
  Simulation& build(double stop, Duration step, std::vector<VariableId> recorded = {}) {
    system = std::make_unique<System>(declaration);
    RunOptions options;
    options.stop = time_from_seconds(stop);
    options.step = step;
    options.recorded = std::move(recorded);
    simulation = std::make_unique<Simulation>(*system, std::move(units), options);
    return *simulation;
  }
};

auto one_in_one_out() { return Describe("io").input("u").output("y").done(); }

std::string failure(Simulation& simulation) {
  try {
    simulation.run();
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Run);
    return error.what();
  }
  return "none";
}

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
  int finished = 0;
  void on_start(std::span<const Signal> signals) override {
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

TEST_CASE("a million steps of 1/3 ms end exactly, and every unit is asked for exact times") {
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

TEST_CASE("an algebraic loop at the start is an error") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  auto& b = f.add("b", one_in_one_out());
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  a.on_initialize =
      b.on_initialize = [](ScriptedUnit& unit) { unit.number(1) = unit.number(0) + 1; };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("algebraic loop"));
}

TEST_CASE("values are converted between units of measurement") {
  Fixture f;
  const BaseUnit metre{{0, 1}, 1, 0};
  const BaseUnit millimetre{{0, 1}, 1e-3, 0};
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
      result.event_needed = true;
    }
    return result;
  };
  a.on_event = [](ScriptedUnit& unit) {
    unit.clock(2) = false;
    return EventResult{};
  };
  b.on_event = [](ScriptedUnit& unit) {  // answers each message with its complement, at once
    EventResult result;
    result.iterate = unit.clock(2) = unit.clock(0);
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

TEST_CASE("a unit without events is never in Event Mode after the start") {
  Fixture f;
  auto& a = f.add("a", messenger());
  f.build(0.003, 1ms).run();
  const ScriptedUnit::Calls expected = {"enter_initialization", "exit_initialization",
                                        "update_discrete_states", "enter_step_mode", "terminate"};
  CHECK(a.calls == expected);
}

TEST_CASE("Event Mode is entered at a unit's next event time, at the first point not before it") {
  Fixture f;
  auto& a = f.add("a", messenger());
  std::vector<std::size_t> steps_before_event;
  std::size_t steps = 0;
  a.on_step = [&](ScriptedUnit&, Time, Time to) {
    ++steps;
    StepResult result;
    result.reached = to;
    return result;
  };
  a.on_event = [&](ScriptedUnit&) {
    steps_before_event.push_back(steps);
    EventResult result;
    if (steps == 0) result.next_event = time_from_seconds(0.0015);
    return result;
  };
  f.build(0.005, 1ms).run();
  CHECK(steps_before_event == std::vector<std::size_t>{0, 2});
}

TEST_CASE("units that tick for ever are named") {
  Fixture f;
  f.add("quiet", messenger());
  auto& a = f.add("restless", messenger());
  a.on_event = [](ScriptedUnit&) {
    EventResult result;
    result.iterate = true;
    return result;
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("'restless'") && !Contains("quiet"));
}

TEST_CASE("an output that is NaN and connected ends the run, and tells who") {
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

TEST_CASE("a step that is rejected or cut short is an error of the fixed-step algorithm") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  const bool reject = GENERATE(true, false);
  a.on_step = [&](ScriptedUnit&, Time from, Time) {
    StepResult result;
    result.rejected = reject;
    result.early_return = !reject;
    result.reached = from;
    return result;
  };
  CHECK_THAT(failure(f.build(1, 1ms)), Contains("unit 'a', at 0 s") && Contains("step"));
}

TEST_CASE("a unit can end the simulation") {
  Fixture f;
  auto& a = f.add("a", one_in_one_out());
  a.on_step = [](ScriptedUnit&, Time, Time to) {
    StepResult result;
    result.reached = to;
    result.terminate = to == time_from_seconds(0.003);
    return result;
  };
  f.build(1, 1ms).run();
  CHECK(f.simulation->statistics().reached == time_from_seconds(0.003));
  CHECK(f.simulation->statistics().terminated_by_unit);
  CHECK(a.calls.back() == "terminate");
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
