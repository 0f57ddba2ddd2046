#include "master/engine/run/events/interventions.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/base/time_text.h"
#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using stride::tests::at;

namespace {

ValueBlock block_of(double value) {
  ValueBlock block(ValueType::Float64, 1);
  block.numbers<double>()[0] = value;
  return block;
}

constexpr ValueReference kRate = 0, kIntegral = 1, kGainOfUnit = 2;

auto summing_up() { return Describe("integrator").input("u").output("y"); }

struct Intervening : ScriptedSystem {
  /// y' = u
  ScriptedUnit& add_integrator(const std::string& name,
                               std::shared_ptr<const UnitDescription> description) {
    ScriptedUnit& unit = add(name, std::move(description));
    unit.on_step = [](ScriptedUnit& self, Time from, Time to) {
      self.number(kIntegral) += self.number(kRate) * to_seconds(to - from);
      return reached(to);
    };
    return unit;
  }
  void intervene(Intervention::Kind kind, VariableId id, double from,
                 std::optional<double> until = {}, std::optional<double> value = {}) {
    Intervention intervention{kind, id, at(from), {}, {}};
    if (until) intervention.until = at(*until);
    if (value) intervention.value = block_of(*value);
    options.interventions.push_back(std::move(intervention));
  }
  void run(double stop = 1, Duration step = 100ms) { build(stop, step).run(); }
};

/// What observers are told.
struct Told : Observer {
  std::vector<std::string> texts;
  void on_intervention(Time time, std::uint32_t index, VariableId id,
                       std::string_view text) override {
    texts.push_back(
        fmt::format("{} {} {}.{} {}", to_text(time), index, id.component, id.variable, text));
  }
};

}  // namespace

TEST_CASE("an input without a source is set at its instant, which is a communication point") {
  Intervening f;
  ScriptedUnit& unit = f.add_integrator("unit", summing_up().done());
  f.intervene(Intervention::Kind::Set, {0, kRate}, 0.25, {}, 1);
  f.intervene(Intervention::Kind::Set, {0, kRate}, 0.75, {}, 3);
  Points points;
  f.build(1, 100ms).add_observer(points);
  f.simulation->run();
  CHECK(unit.number(kIntegral) == Approx(0.5 * 1 + 0.25 * 3));
  CHECK(std::ranges::count(points.times, at(0.25)) == 1);
  CHECK(points.times.size() == 13);
}

TEST_CASE("a connected input is forced for its time, whatever the inputs are extrapolated by") {
  Intervening f;
  f.options.coupling = GENERATE(Coupling::Jacobi, Coupling::GaussSeidel);
  f.options.extrapolation =
      GENERATE(Extrapolation::Hold, Extrapolation::Linear, Extrapolation::Quadratic);
  ScriptedUnit& source = f.add("source", Describe("source").output("y").done());
  source.on_initialize = [](ScriptedUnit& self) { self.number(0) = 5; };
  ScriptedUnit& unit = f.add_integrator("unit", summing_up().done());
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0.25, 0.55, 1);
  f.run();
  CHECK(unit.number(kIntegral) == Approx(5 * 0.7 + 1 * 0.3));
}

TEST_CASE("an input is held at the value of its instant") {
  Intervening f;
  ScriptedUnit& source = f.add("source", Describe("source").output("y").done());
  source.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.number(0) = to_seconds(to.time_since_epoch());
    return reached(to);
  };
  ScriptedUnit& unit = f.add("unit", summing_up().done());
  std::vector<double> seen;
  unit.on_step = [&](ScriptedUnit& self, Time, Time to) {
    seen.push_back(self.number(kRate));
    return reached(to);
  };
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Hold, {1, kRate}, 0.25, 0.4);
  f.run(0.6);
  CHECK(seen == std::vector<double>{0, 0.1, 0.2, 0.25, 0.25, 0.4, 0.5});
}

TEST_CASE(
    "an intervention without an end lasts to the end of the run, and one may follow another") {
  Intervening f;
  f.add("source", Describe("source").output("y").done());
  ScriptedUnit& unit = f.add_integrator("unit", summing_up().done());
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0, 0.5, 1);
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0.5, {}, 2);
  Told told;
  f.build(1, 100ms).add_observer(told);
  f.simulation->run();
  CHECK(unit.number(kIntegral) == Approx(0.5 * 1 + 0.5 * 2));
  CHECK(told.texts == std::vector<std::string>{"0 0 1.0 forced to 1 until 0.5 s",
                                               "0.5 0 1.0 released", "0.5 0 1.0 forced to 2"});
}

TEST_CASE("a unit with Event Mode is in it where one of its variables changes") {
  Intervening f;
  f.add("source", Describe("source").output("y").done());
  ScriptedUnit& unit = f.add_integrator(
      "unit",
      summing_up().add("gain", ValueType::Float64, Causality::Parameter).event_mode().done());
  std::vector<std::string> events;
  unit.on_event = [&](ScriptedUnit& self) {
    events.push_back(fmt::format("u {} gain {}", self.number(kRate), self.number(kGainOfUnit)));
    return EventResult{};
  };
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0.25, 0.55, 1);
  f.intervene(Intervention::Kind::Set, {1, kGainOfUnit}, 0.35, {}, 7);
  f.run();
  CHECK(events == std::vector<std::string>{"u 0 gain 0", "u 1 gain 0", "u 1 gain 7", "u 0 gain 7"});
}

TEST_CASE("an output that jumps by an event does not reach an input that is forced") {
  Intervening f;
  const bool is_direct = GENERATE(false, true);
  ScriptedUnit& source = f.add("source", Describe("source").output("y").event_mode().done());
  int tenths = 0;
  source.on_step = [&](ScriptedUnit&, Time, Time to) {
    tenths = static_cast<int>(std::round(10 * to_seconds(to.time_since_epoch()) - 0.25));
    return reached(to);
  };
  source.on_event = [&](ScriptedUnit& self) {
    self.number(0) = 10 * (tenths + 1);
    EventResult result;
    result.next_event_time = at(0.1 * (tenths + 1));
    return result;
  };
  auto description = Describe("unit").input("u").output("y").event_mode();
  if (is_direct) description.depends_on({0});
  ScriptedUnit& unit = f.add("unit", description.done());
  std::vector<double> seen;
  unit.on_step = [&](ScriptedUnit& self, Time, Time to) {
    seen.push_back(self.number(kRate));
    return reached(to);
  };
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0.15, 0.35, -1);
  f.run(0.4, 50ms);
  CHECK(seen == std::vector<double>{10, 10, 20, -1, -1, -1, -1, 40});
}

TEST_CASE("a discrete input is forced, and has what its source gives afterwards") {
  Intervening f;
  ScriptedUnit& source =
      f.add("source",
            Describe("source").add("y", ValueType::Int32, Causality::Output).event_mode().done());
  source.on_event = [](ScriptedUnit& self) {
    self.block(0).numbers<std::int32_t>()[0] = 4;
    return EventResult{};
  };
  ScriptedUnit& unit = f.add(
      "unit", Describe("unit").add("u", ValueType::Int32, Causality::Input).event_mode().done());
  std::vector<int> seen;
  unit.on_step = [&](ScriptedUnit& self, Time, Time to) {
    seen.push_back(self.block(0).numbers<std::int32_t>()[0]);
    return reached(to);
  };
  f.wire("source", "y", "unit", "u");
  ValueBlock value(ValueType::Int32, 1);
  value.numbers<std::int32_t>()[0] = 9;
  f.options.interventions.push_back({Intervention::Kind::Force, {1, 0}, at(0.1), at(0.3), value});
  f.run(0.4);
  CHECK(seen == std::vector<int>{4, 9, 9, 4});
}

TEST_CASE("a unit that is suspended goes on from an intervention") {
  Intervening f;
  const bool has_events = GENERATE(false, true);
  auto description = summing_up().promises_idle();
  if (has_events) description.event_mode();
  ScriptedUnit& unit = f.add_integrator("unit", description.done());
  unit.on_idle_until = [](ScriptedUnit& self) {
    return self.number(kRate) == 0 ? Time::max() : Time::min();
  };
  f.options.idle.max_skip = {Duration::max()};
  f.intervene(Intervention::Kind::Set, {0, kRate}, 0.25, {}, 1);
  f.run();
  CHECK(unit.number(kIntegral) == Approx(0.75));
  CHECK(f.simulation->statistics().units[0].suspensions == 1);
}

TEST_CASE("an input stays forced where a unit is rolled back") {
  Intervening f;
  f.add("source", Describe("source").output("y").can_save_state().done());
  ScriptedUnit& unit = f.add_integrator("unit", summing_up().can_save_state().done());
  ScriptedUnit& rejecter = f.add("rejecter", Describe("rejecter").done());
  rejecter.on_step = [](ScriptedUnit&, Time from, Time to) {
    StepResult result = reached(to);
    result.rejected = to - from > 30ms;
    return result;
  };
  f.wire("source", "y", "unit", "u");
  f.intervene(Intervention::Kind::Force, {1, kRate}, 0.25, 0.55, 1);
  f.run();
  CHECK(unit.number(kIntegral) == Approx(0.3));
}

namespace {

constexpr ValueReference kTick = 0, kBytes = 1;

/// One that sends its number at each multiple of a tenth of a second, and one that notes what it
/// receives.
struct Talking : Intervening {
  ScriptedUnit& sender = add("sender", Describe("sender")
                                           .add("tick", ValueType::Clock, Causality::Output)
                                           .add("bytes", ValueType::Binary, Causality::Output)
                                           .clocked_by(kTick)
                                           .done());
  ScriptedUnit& receiver = add("receiver", Describe("receiver")
                                               .add("tick", ValueType::Clock, Causality::Input)
                                               .add("bytes", ValueType::Binary, Causality::Input)
                                               .clocked_by(kTick)
                                               .done());
  Time now{};
  std::uint8_t sent = 0;
  std::vector<std::pair<Time, Binary>> received;

  Talking() {
    wire("sender", "tick", "receiver", "tick");
    wire("sender", "bytes", "receiver", "bytes");
    sender.on_step = [this](ScriptedUnit& self, Time, Time to) {
      now = to;
      StepResult result = reached(to);
      self.clock(kTick) = result.event_handling_needed = to.time_since_epoch() % 100ms == 0ms;
      if (self.clock(kTick)) self.binary(kBytes) = {++sent, 0, 0, 0};
      return result;
    };
    sender.on_event = [](ScriptedUnit& self) {
      self.clock(kTick) = false;
      return EventResult{};
    };
    receiver.on_event = [this](ScriptedUnit& self) {
      if (std::exchange(self.clock(kTick), false)) received.emplace_back(now, self.binary(kBytes));
      return EventResult{};
    };
  }
  void disturb(Intervention::Kind kind, double from, std::optional<double> until,
               Duration delay = {}) {
    Intervention intervention{kind, {1, kBytes}, at(from), {}, {}, {1, kTick}, delay, 3, 1, 7};
    if (until) intervention.until = at(*until);
    options.interventions.push_back(std::move(intervention));
  }
  /// The numbers that have arrived, each with its time in milliseconds.
  std::vector<std::pair<std::int64_t, int>> arrivals() const {
    std::vector<std::pair<std::int64_t, int>> all;
    for (const auto& [time, bytes] : received) {
      all.emplace_back(time.time_since_epoch() / 1ms, bytes.at(0));
    }
    return all;
  }
};

using Arrivals = std::vector<std::pair<std::int64_t, int>>;

}  // namespace

TEST_CASE("messages are dropped for a time, and others see them") {
  struct Messages : Observer {
    int sent = 0, received = 0;
    void on_message(const Message& message) override { ++(message.received ? received : sent); }
  };
  Talking f;
  f.disturb(Intervention::Kind::Drop, 0.2, 0.4);
  Messages messages;
  Told told;
  f.build(0.5, 50ms).add_observer(messages);
  f.simulation->add_observer(told);
  f.simulation->run();
  CHECK(f.arrivals() == Arrivals{{100, 1}, {400, 4}, {500, 5}});
  CHECK(messages.sent == 5);
  CHECK(messages.received == 3);
  CHECK(told.texts == std::vector<std::string>{"0.2 0 1.1 messages are dropped until 0.4 s",
                                               "0.2 0 1.1 dropped", "0.3 0 1.1 dropped",
                                               "0.4 0 1.1 messages are received as they are sent"});
}

TEST_CASE("messages are delayed, and arrive at their instants, one at a time") {
  Talking f;
  SECTION("between communication points") {
    f.disturb(Intervention::Kind::Delay, 0.2, 0.3, 33ms);
    f.run(0.5, 50ms);
    CHECK(f.arrivals() == Arrivals{{100, 1}, {233, 2}, {300, 3}, {400, 4}, {500, 5}});
  }
  SECTION("where others arrive") {
    f.disturb(Intervention::Kind::Delay, 0.2, 0.3, 100ms);
    f.run(0.5, 50ms);
    CHECK(f.arrivals() == Arrivals{{100, 1}, {300, 2}, {300, 3}, {400, 4}, {500, 5}});
  }
  SECTION("two at one instant") {
    f.disturb(Intervention::Kind::Delay, 0.1, 0.2, 300ms);
    f.disturb(Intervention::Kind::Delay, 0.2, 0.3, 200ms);
    f.run(0.5, 50ms);
    CHECK(f.arrivals() == Arrivals{{300, 3}, {400, 1}, {400, 2}, {400, 4}, {500, 5}});
  }
  SECTION("after the end of the run") {
    f.disturb(Intervention::Kind::Delay, 0.2, {}, 301ms);
    f.run(0.5, 50ms);
    CHECK(f.arrivals() == Arrivals{{100, 1}});
  }
}

TEST_CASE("messages have bit errors, behind their headers, the same in each run") {
  Talking f, again;
  for (Talking* system : {&f, &again}) {
    system->disturb(Intervention::Kind::Corrupt, 0.2, 0.4);
    system->run(0.5, 50ms);
  }
  CHECK(f.received == again.received);
  REQUIRE(f.received.size() == 5);
  const auto wrong_bits = [&](std::size_t i) {
    int bits = 0;
    const Binary& bytes = f.received[i].second;
    CHECK(bytes.at(0) == i + 1);
    for (std::size_t b = 1; b < bytes.size(); ++b) bits += std::popcount(bytes[b]);
    return bits;
  };
  CHECK(wrong_bits(0) == 0);
  CHECK(wrong_bits(1) == 3);
  CHECK(wrong_bits(2) == 3);
  CHECK(wrong_bits(3) == 0);
  CHECK(f.received[1].second != f.received[2].second);
}
