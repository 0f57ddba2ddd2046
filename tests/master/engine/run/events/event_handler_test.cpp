// Values that follow others at the instant of an event.
#include "master/engine/run/events/event_handler.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

const BaseUnitOfMeasure kKelvin{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0};
const BaseUnitOfMeasure kCelsius{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15};

struct RecordedRows : Observer {
  std::vector<Signal> signals;
  std::vector<Time> times;
  std::vector<std::vector<double>> rows;
  void on_start(std::span<const Signal> recorded) override {
    signals.assign(recorded.begin(), recorded.end());
  }
  void on_communication_point(Time time) override {
    times.push_back(time);
    auto& row = rows.emplace_back();
    for (const Signal& signal : signals) {
      row.push_back(signal.block->numbers<double>()[signal.first]);
    }
  }
  const std::vector<double>& at(double seconds) const {
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] == time_from_seconds(seconds)) return rows[i];
    }
    throw std::runtime_error("no such instant");
  }
};

constexpr double kJump = 0.0025;  // between two points of the grid

/// Units whose output is f(u), at the start, at events, and at the end of each step.
struct EventSystem : ScriptedSystem {
  RecordedRows seen;
  Time now{};
  std::map<std::string, int> events;  ///< event iterations after the start

  ScriptedUnit& follower(const std::string& name, std::function<double(double)> f,
                         bool event_mode = true) {
    Describe description("follower");
    description.input("u").output("y").depends_on({0});
    if (event_mode) description.event_mode();
    ScriptedUnit& unit = add(name, description.done());
    const auto show = [f](ScriptedUnit& self) { self.number(1) = f(self.number(0)); };
    unit.on_initialize = unit.on_read_in_event_mode = show;
    unit.on_step = [this, show](ScriptedUnit& self, Time, Time to) {
      now = to;
      show(self);
      return reached(to);
    };
    unit.on_event = [this, name](ScriptedUnit&) {
      if (now > Time{}) ++events[name];
      return EventResult{};
    };
    return unit;
  }
  /// Its output jumps from 1 to 2 at kJump.
  ScriptedUnit& source() {
    ScriptedUnit& unit =
        add("source", Describe("source").output("y").depends_on({}).event_mode().done());
    unit.on_initialize = [](ScriptedUnit& self) { self.number(0) = 1; };
    unit.on_step = [this](ScriptedUnit&, Time, Time to) {
      now = to;
      return reached(to);
    };
    unit.on_event = [this](ScriptedUnit& self) {
      if (now > Time{}) ++events["source"];
      EventResult result;
      if (now < time_from_seconds(kJump)) {
        result.next_event_time = time_from_seconds(kJump);
      } else {
        self.number(0) = 2;
      }
      return result;
    };
    return unit;
  }
  /// Records the outputs y of all components.
  void run(double stop = 0.004) {
    std::vector<VariableId> recorded;
    for (std::size_t i = 0; i < instances.size(); ++i) {
      recorded.push_back({i, *declaration.components[i].description->find("y")});
    }
    build(stop, 1ms, recorded).add_observer(seen);
    simulation->run();
  }
};

double one_more(double u) { return u + 1; }

}  // namespace

TEST_CASE("a jump goes through a chain at its own instant") {
  EventSystem f;
  f.follower("c", one_more);
  f.follower("b", one_more);
  f.follower("a", one_more);
  f.source();
  f.wire("source", "y", "a", "u");
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "c", "u");
  f.run();
  CHECK(f.seen.at(0.002) == std::vector<double>{4, 3, 2, 1});
  CHECK(f.seen.at(kJump) == std::vector<double>{5, 4, 3, 2});
  // the source announced it; the others were called for one more iteration, in which they follow
  CHECK(f.events == std::map<std::string, int>{{"a", 1}, {"b", 1}, {"c", 1}, {"source", 2}});
}

TEST_CASE("a unit without Event Mode keeps its outputs until the next step") {
  EventSystem f;
  f.follower("b", one_more);
  f.follower("a", one_more, false);
  f.source();
  f.wire("source", "y", "a", "u");
  f.wire("a", "y", "b", "u");
  f.run();
  CHECK(f.seen.at(kJump) == std::vector<double>{3, 2, 2});
  CHECK(f.seen.at(0.003) == std::vector<double>{3, 3, 2});
  CHECK(f.seen.at(0.004) == std::vector<double>{4, 3, 2});
  CHECK(f.events == std::map<std::string, int>{{"source", 1}});
}

TEST_CASE("a jump is an event of the receiver, too, where no output follows it") {
  EventSystem f;
  auto& b = f.add("b", Describe("b").input("u").output("y").depends_on({}).event_mode().done());
  int events = 0;
  b.on_event = [&](ScriptedUnit&) {
    ++events;
    return EventResult{};
  };
  f.source();
  f.wire("source", "y", "b", "u");
  f.run();
  CHECK(events == 2);
  CHECK(b.number(0) == 2);
}

TEST_CASE("a loop is solved at the instant of a jump") {
  const double slope = GENERATE(0.5, -0.5, -3.0, 20.0);
  EventSystem f;
  auto& a = f.add(
      "a", Describe("a").input("u").output("y").depends_on({0, 2}).input("v").event_mode().done());
  f.follower("b", [](double u) { return u; });
  f.source();
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  f.wire("source", "y", "a", "v");
  a.on_initialize = a.on_read_in_event_mode = [&](ScriptedUnit& unit) {
    unit.number(1) = slope * unit.number(0) + unit.number(2);
  };
  f.run(kJump);
  CHECK(f.seen.at(0)[0] == Approx(1 / (1 - slope)).epsilon(1e-12));
  CHECK(f.seen.at(kJump)[0] == Approx(2 / (1 - slope)).epsilon(1e-12));
  CHECK(f.seen.at(kJump)[1] == Approx(2 / (1 - slope)).epsilon(1e-12));
  CHECK(f.simulation->statistics().event_iterations <= 4);
}

TEST_CASE("a loop that has no solution after a jump is an error at that instant") {
  EventSystem f;
  auto& a = f.add(
      "a", Describe("a").input("u").output("y").depends_on({0, 2}).input("v").event_mode().done());
  f.follower("b", [](double u) { return u; });
  f.source();
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  f.wire("source", "y", "a", "v");
  a.on_initialize = a.on_read_in_event_mode = [&](ScriptedUnit& unit) {
    unit.number(1) = unit.number(2) < 1.5 ? 0.5 * unit.number(0) : unit.number(0) + 1;
  };
  CHECK_THROWS_WITH(f.run(), Contains("at 0.0025 s") && Contains("a.u -> a.y -> b.u -> b.y"));
}

TEST_CASE("a Boolean that goes through a chain at the instant of an event is an event of each") {
  EventSystem f;
  const auto relay = Describe("relay")
                         .add("u", ValueType::Boolean, Causality::Input)
                         .add("y", ValueType::Boolean, Causality::Output)
                         .depends_on({0})
                         .event_mode()
                         .done();
  auto& b = f.add("b", relay);
  auto& a = f.add("a", relay);
  f.wire("a", "y", "b", "u");
  f.wire("trigger", "y", "a", "u");
  auto& trigger = f.add("trigger", Describe("trigger")
                                       .add("y", ValueType::Boolean, Causality::Output)
                                       .depends_on({})
                                       .event_mode()
                                       .done());
  a.on_initialize =
      a.on_read_in_event_mode = [](ScriptedUnit& unit) { unit.clock(1) = unit.clock(0); };
  b.on_initialize =
      b.on_read_in_event_mode = [](ScriptedUnit& unit) { unit.clock(1) = !unit.clock(0); };
  std::vector<bool> seen_in_events;
  b.on_event = [&](ScriptedUnit& unit) {
    seen_in_events.push_back(unit.clock(0));
    return EventResult{};
  };
  trigger.on_step = [&](ScriptedUnit& unit, Time, Time to) {
    unit.clock(0) = to >= time_from_seconds(0.002);
    return reached(to);
  };
  f.build(0.003, 1ms).run();
  CHECK(seen_in_events.front() == false);
  CHECK(seen_in_events.back() == true);
  CHECK(b.clock(0));
  // the start, the jump of its input, and the iteration that the change asks for
  CHECK(seen_in_events.size() <= 3);
}

TEST_CASE("at instants without an event only outputs are read") {
  EventSystem f;
  auto& a = f.follower("a", one_more);
  f.follower("b", one_more);
  f.wire("a", "y", "b", "u");
  f.build(1, 1ms).run();
  const int at_start = a.gets;
  CHECK(at_start < 1000 + 10);
  CHECK(f.simulation->statistics().event_iterations == 1);
}

TEST_CASE("a jump is converted on its way, with the offset, and is one if the value changes") {
  EventSystem f;
  f.add("source",
        Describe("source").output("y", "degC").unit("degC", kCelsius).event_mode().done());
  ScriptedUnit& source = *f.instances[0];
  source.on_step = [&f](ScriptedUnit&, Time, Time to) {
    f.now = to;
    return reached(to);
  };
  source.on_event = [&f](ScriptedUnit& self) {
    EventResult result;
    if (f.now < time_from_seconds(kJump)) {
      result.next_event_time = time_from_seconds(kJump);
    } else {
      self.number(0) = 10;
    }
    return result;
  };
  const bool follows = GENERATE(false, true);
  Describe reader("reader");
  reader.input("u", "K").unit("K", kKelvin).output("y").event_mode();
  reader.depends_on(follows ? std::vector<ValueReference>{0} : std::vector<ValueReference>{});
  ScriptedUnit& unit = f.add("reader", reader.done());
  std::vector<double> at_events;
  unit.on_event = [&](ScriptedUnit& self) {
    at_events.push_back(self.number(0));
    return EventResult{};
  };
  f.wire("source", "y", "reader", "u");
  f.build(0.004, 1ms).run();
  CHECK(at_events.front() == Approx(273.15));
  REQUIRE(at_events.size() == 2);  // the start and the jump
  CHECK(at_events.back() == Approx(283.15));
}

TEST_CASE("at one instant messages are in the order of the units, and of their clocks") {
  struct Sent : Observer {
    std::vector<std::string> names;
    const System* system = nullptr;
    void on_message(const Message& message) override {
      names.push_back(system->full_name(message.id));
    }
  };
  EventSystem f;
  for (const char* name : {"second", "first"}) {
    ScriptedUnit& unit = f.add(name, Describe("sender")
                                         .add("z", ValueType::Clock, Causality::Output)
                                         .add("a", ValueType::Clock, Causality::Output)
                                         .event_mode()
                                         .done());
    unit.on_event = [](ScriptedUnit& self) {
      self.clock(0) = self.clock(1) = false;
      return EventResult{};
    };
    unit.on_initialize = [](ScriptedUnit& self) { self.clock(0) = self.clock(1) = true; };
  }
  Sent sent;
  f.build(0.001, 1ms).add_observer(sent);
  sent.system = f.system.get();
  f.simulation->run();
  CHECK(sent.names == std::vector<std::string>{"second.z", "second.a", "first.z", "first.a"});
}

TEST_CASE("a thousand event iterations at one instant are allowed, one more is not") {
  const int last = GENERATE(1000, 1001);
  EventSystem f;
  ScriptedUnit& unit = f.add("unit", Describe("unit").output("y").event_mode().done());
  int iterations = 0;
  unit.on_event = [&](ScriptedUnit&) {
    EventResult result;
    result.discrete_states_need_update = ++iterations < last;
    return result;
  };
  const std::string error = failure(f.build(0.001, 1ms));
  CHECK((error == "none") == (last == 1000));
}
