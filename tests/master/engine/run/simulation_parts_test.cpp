// A run in parts: Simulation::begin(), advance(), make_event(), value(), end().
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"
#include "tests/master/engine/run/cut_run.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using stride::tests::at;

namespace {

constexpr ValueReference kRateOfPart = 0, kSumOfPart = 1;
constexpr VariableId kRateId{0, kRateOfPart}, kSumId{0, kSumOfPart};

ValueBlock value_block(double value) {
  ValueBlock block(ValueType::Float64, 1);
  block.numbers<double>()[0] = value;
  return block;
}

Intervention set_now(double value, Time now) {
  return {.id = kRateId, .from = now, .value = value_block(value)};
}

double value_of(Simulation& simulation, VariableId id) {
  return simulation.value(id).numbers<double>()[0];
}

struct InParts : ScriptedSystem {
  Points points;

  /// y' = u
  ScriptedUnit& add_integrator(bool has_events = false) {
    Describe description("integrator");
    description.input("u").output("y");
    if (has_events) description.event_mode();
    ScriptedUnit& unit = add("unit", description.done());
    unit.on_step = [](ScriptedUnit& self, Time from, Time to) {
      self.number(kSumOfPart) += self.number(kRateOfPart) * to_seconds(to - from);
      return reached(to);
    };
    return unit;
  }
  Simulation& begun(double stop = 1, Duration step = 100ms) {
    build(stop, step).add_observer(points);
    simulation->begin();
    return *simulation;
  }
};

}  // namespace

TEST_CASE("a run in parts at its own communication points is the run as a whole") {
  InParts parts, whole;
  parts.options.steps_in_stretches = whole.options.steps_in_stretches = GENERATE(false, true);
  parts.add_integrator();
  whole.add_integrator();
  Simulation& simulation = parts.begun();
  for (const double time : {0.1, 0.3, 0.3, 0.9, 1.0}) simulation.advance(at(time));
  simulation.end();
  CHECK(parts.points.times == points(whole, 1, 100ms));
  CHECK(simulation.statistics().communication_steps ==
        whole.simulation->statistics().communication_steps);
  CHECK(parts.instances[0]->calls == whole.instances[0]->calls);
}

TEST_CASE("a step ends where a part does, and the grid goes on behind it") {
  InParts f;
  f.options.steps_in_stretches = GENERATE(false, true);
  f.add_integrator();
  Simulation& simulation = f.begun(0.5);
  simulation.advance(at(0.25));
  CHECK(simulation.statistics().reached == at(0.25));
  simulation.advance(at(0.4));
  simulation.end();
  CHECK(f.points.times == std::vector{at(0), at(0.1), at(0.2), at(0.25), at(0.3), at(0.4)});
}

TEST_CASE("a part ends at the stop time at the latest, or where a unit ends the run") {
  InParts f;
  ScriptedUnit& unit = f.add_integrator();
  const bool ends = GENERATE(false, true);
  unit.on_step = [&](ScriptedUnit&, Time, Time to) {
    StepResult result = reached(to);
    result.terminate_simulation = ends && to == at(0.3);
    return result;
  };
  Simulation& simulation = f.begun(0.5);
  simulation.advance(at(7));
  simulation.advance(at(8));
  CHECK(simulation.statistics().reached == (ends ? at(0.3) : at(0.5)));
  CHECK(simulation.statistics().end == (ends ? RunEnd::EndedByUnit : RunEnd::Completed));
  simulation.end();
}

TEST_CASE("what is set between the parts counts from there on, and is observed") {
  InParts f;
  const bool has_events = GENERATE(false, true);
  ScriptedUnit& unit = f.add_integrator(has_events);
  std::vector<double> in_events;
  unit.on_event = [&](ScriptedUnit& self) {
    in_events.push_back(self.number(kRateOfPart));
    return EventResult{};
  };
  Simulation& simulation = f.begun();
  simulation.make_event({.sets = {set_now(2, at(0))}});
  simulation.advance(at(0.5));
  simulation.make_event({.sets = {set_now(4, at(0.5))}});
  simulation.advance(at(1));
  simulation.end();
  CHECK(unit.number(kSumOfPart) == Approx(0.5 * 2 + 0.5 * 4));
  CHECK(std::ranges::count(f.points.times, at(0.5)) == 2);
  if (has_events) CHECK(in_events == std::vector<double>{0, 2, 4});
}

TEST_CASE("an intervention that is made between the parts may begin and end later") {
  InParts f;
  ScriptedUnit& unit = f.add_integrator();
  f.add("source", Describe("source").output("y").done());
  f.wire("source", "y", "unit", "u");
  Simulation& simulation = f.begun();
  simulation.advance(at(0.2));
  Intervention force{.kind = Intervention::Kind::Force, .id = kRateId, .from = at(0.25)};
  force.until = at(0.75);
  force.value = value_block(4);
  simulation.make_event({.interventions = {force}});
  simulation.advance(at(1));
  simulation.end();
  CHECK(unit.number(kSumOfPart) == Approx(0.5 * 4));
}

TEST_CASE("the value of any variable can be read between the parts") {
  InParts f;
  f.add_integrator();
  ScriptedUnit& sink = f.add("sink", Describe("sink").input("u").done());
  sink.on_step = [](ScriptedUnit&, Time, Time to) { return reached(to); };
  const bool is_connected = GENERATE(false, true);
  if (is_connected) f.wire("unit", "y", "sink", "u");
  Simulation& simulation = f.begun();
  simulation.make_event({.sets = {set_now(2, at(0))}});
  simulation.advance(at(0.5));
  CHECK(value_of(simulation, kRateId) == 2);
  CHECK(value_of(simulation, kSumId) == Approx(1));
  CHECK(value_of(simulation, {1, 0}) == (is_connected ? Approx(1) : Approx(0)));
  simulation.end();
}

TEST_CASE("a message that is sent between the parts is received and observed at its instant") {
  InParts f;
  ScriptedUnit& unit = f.add("unit", Describe("receiver")
                                         .add("command", ValueType::Clock, Causality::Input)
                                         .add("frame", ValueType::Binary, Causality::Input)
                                         .clocked_by(0)
                                         .done());
  std::vector<std::string> received;
  unit.on_event = [&](ScriptedUnit& self) {
    if (self.clock(0)) received.push_back(fmt::format("{} bytes", self.binary(1).size()));
    return EventResult{};
  };
  struct Messages : Observer {
    std::vector<std::string> texts;
    void on_message(const Message& message) override {
      texts.push_back(fmt::format("{} {} {}", to_seconds(message.time.time_since_epoch()),
                                  message.id.variable, message.received));
    }
  } messages;
  f.build(1, 100ms).add_observer(messages);
  Simulation& simulation = *f.simulation;
  simulation.begin();
  simulation.advance(at(0.35));
  SentMessage message{.clock = {0, 0}, .values = {{{0, 1}, ValueBlock(ValueType::Binary, 1)}}};
  message.values[0].block.binaries()[0] = Binary(3);
  simulation.make_event({.messages = {message}});
  simulation.advance(at(1));
  simulation.end();
  CHECK(received == std::vector<std::string>{"3 bytes"});
  CHECK(messages.texts == std::vector<std::string>{"0.35 1 true"});
  CHECK(simulation.statistics().units[0].messages_received == 1);
}

TEST_CASE("a part that fails ends the run") {
  InParts f;
  ScriptedUnit& unit = f.add_integrator();
  unit.on_step = [](ScriptedUnit&, Time, Time to) -> StepResult {
    if (to > at(0.3)) fail_run({}, "broken");
    return reached(to);
  };
  Simulation& simulation = f.begun();
  simulation.advance(at(0.3));
  CHECK_THROWS_AS(simulation.advance(at(0.5)), Error);
  CHECK(unit.calls.back() == "terminate");
  CHECK_THROWS_AS(simulation.advance(at(0.6)), std::logic_error);
  CHECK_THROWS_AS(simulation.end(), std::logic_error);
}

TEST_CASE("the parts of a run have an order") {
  InParts f;
  f.add_integrator();
  Simulation& simulation = f.build(1, 100ms);
  CHECK_THROWS_AS(simulation.advance(at(1)), std::logic_error);
  CHECK_THROWS_AS(simulation.value(kSumId), std::logic_error);
  simulation.begin();
  CHECK_THROWS_AS(simulation.begin(), std::logic_error);
  CHECK_THROWS_AS(simulation.run(), std::logic_error);
  CHECK_THROWS_AS(simulation.make_event({.interventions = {set_now(1, at(-1))}}), std::logic_error);
  CHECK_THROWS_AS(simulation.end(), std::logic_error);
}
