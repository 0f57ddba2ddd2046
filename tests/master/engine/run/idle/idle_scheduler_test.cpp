#include "master/engine/run/idle/idle_scheduler.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

using stride::tests::at;

struct Made {
  Time from, to;
  double input;
  bool operator==(const Made&) const = default;
};

/// y' = u, exactly, so y is on its tangent as long as u stays; promises to be idle until `until`.
struct Integrator {
  ScriptedUnit* unit;
  std::vector<Made> steps;
  Time until = Time::max();
  std::function<void(Time from, Time to, StepResult& result)> misbehave = [](Time, Time,
                                                                             StepResult&) {};

  static Describe description(double deadband = 0) {
    return Describe("integrator")
        .input("u")
        .deadband(deadband)
        .output("y")
        .tolerance(1e-6)
        .event_mode()
        .promises_idle();
  }

  explicit Integrator(ScriptedUnit& scripted) : unit(&scripted) {
    unit->on_step = [this](ScriptedUnit& self, Time from, Time to) {
      steps.push_back({from, to, self.number(0)});
      self.number(1) += self.number(0) * to_seconds(to - from);
      StepResult result = reached(to);
      misbehave(from, to, result);
      return result;
    };
    unit->on_idle_until = [this](ScriptedUnit&) { return until; };
    unit->on_slope = [](ScriptedUnit& self, ValueReference) { return self.number(0); };
  }
};

/// y = f(time), at each point that it comes to.
ScriptedUnit& follow_time(ScriptedSystem& system, const std::string& name,
                          std::function<double(double)> f) {
  ScriptedUnit& unit = system.add(name, Describe("source").output("y").never_rejects().done());
  unit.on_initialize = [f](ScriptedUnit& self) { self.number(0) = f(0); };
  unit.on_step = [f](ScriptedUnit& self, Time, Time to) {
    self.number(0) = f(to_seconds(to));
    return reached(to);
  };
  return unit;
}

/// What a unit is given for each step, by the instant where that begins.
struct Reader {
  std::map<Time, double> seen;
  Reader(ScriptedSystem& system, const std::string& name) {
    system.add(name, Describe("reader").input("u").never_rejects().done()).on_step =
        [this](ScriptedUnit& self, Time from, Time to) {
          seen[from] = self.number(0);
          return reached(to);
        };
  }
};

struct IdleSystem : ScriptedSystem {
  Integrator& integrator(const std::string& name, double deadband = 0) {
    return *integrators.emplace_back(
        std::make_unique<Integrator>(add(name, Integrator::description(deadband).done())));
  }
  Simulation& run(double stop, Duration step, Duration max_skip = 1s) {
    options.idle.max_skip.assign(declaration.components.size(), max_skip);
    build(stop, step).run();
    return *simulation;
  }
  const UnitStatistics& statistics(std::size_t component) const {
    return simulation->statistics().units.at(component);
  }
  std::vector<std::unique_ptr<Integrator>> integrators;
};

}  // namespace

TEST_CASE("an idle unit is called once in max_skip, and its readers see its tangent") {
  IdleSystem f;
  auto& a = f.integrator("a");
  Reader b(f, "b");
  a.unit->on_initialize = [](ScriptedUnit& self) { self.number(0) = 2; };
  f.wire("a", "y", "b", "u");
  f.run(2.5, 100ms);
  CHECK(a.steps == std::vector<Made>{{at(0), at(1), 2}, {at(1), at(2), 2}, {at(2), at(2.5), 2}});
  REQUIRE(b.seen.size() == 25);
  for (const auto& [time, value] : b.seen) CHECK(value == Approx(2 * to_seconds(time)));
  CHECK(f.statistics(0).steps == 3);
  CHECK(f.statistics(0).suspensions == 3);
  CHECK(f.statistics(0).suspended_time == Duration(2500ms));
  CHECK(f.statistics(0).longest_suspension == Duration(1s));
}

TEST_CASE("without max_skip no unit is suspended, and no promise is read") {
  IdleSystem f;
  auto& a = f.integrator("a");
  f.build(1, 100ms).run();
  CHECK(a.steps.size() == 10);
  CHECK_FALSE(a.unit->max_skip);
}

TEST_CASE("skipping is enabled before the initialization, with the tolerances that were chosen") {
  IdleSystem f;
  auto& a = f.integrator("a");
  f.options.idle.tolerances = {{{0, 1}, 0.25}};
  f.run(1, 100ms, 300ms);
  CHECK(a.unit->max_skip == Duration(300ms));
  REQUIRE(a.unit->calls.size() > 2);
  CHECK(a.unit->calls[0] == "enable_idle_skipping");
  CHECK(a.unit->calls[1] == "tolerance 1 0.25");
  CHECK(a.unit->calls[2] == "enter_initialization");
}

TEST_CASE("a unit catches up with the old input, then the new one is set") {
  IdleSystem f;
  auto& a = f.integrator("a");
  follow_time(f, "s", [](double t) { return t < 0.35 ? 1 : 5; });
  Reader b(f, "b");
  f.wire("s", "y", "a", "u");
  f.wire("a", "y", "b", "u");
  f.run(1, 100ms, 10s);
  CHECK(a.steps == std::vector<Made>{{at(0), at(0.4), 1}, {at(0.4), at(1), 5}});
  CHECK(b.seen.at(at(0.3)) == Approx(0.3));
  CHECK(b.seen.at(at(0.9)) == Approx(0.4 + 5 * 0.5));
}

TEST_CASE("an input within its deadband ends no suspension; a drift does in the end") {
  const double deadband = GENERATE(0.0, 0.25, 10.0);
  IdleSystem f;
  auto& a = f.integrator("a", deadband);
  follow_time(f, "s", [](double t) { return t; });
  f.wire("s", "y", "a", "u");
  f.run(1, 125ms, 10s);
  const std::size_t calls = deadband == 0 ? 8 : deadband == 0.25 ? 3 : 1;
  CHECK(a.steps.size() == calls);
}

TEST_CASE("a deadband of the user takes precedence over that of the unit") {
  IdleSystem f;
  auto& a = f.integrator("a", 10);
  follow_time(f, "s", [](double t) { return t; });
  f.wire("s", "y", "a", "u");
  f.options.idle.deadbands = {{{0, 0}, 0.25}};
  f.run(1, 125ms, 10s);
  CHECK(a.steps.size() == 3);
}

TEST_CASE("where the promise ends the unit is called, and may have an event") {
  IdleSystem f;
  auto& a = f.integrator("a");
  a.until = at(0.4);
  int events = 0;
  a.unit->on_event = [&](ScriptedUnit&) {
    ++events;
    return EventResult{};
  };
  a.misbehave = [&](Time, Time to, StepResult& result) {
    result.event_handling_needed = to == at(0.4);
    if (to >= at(0.4)) a.until = Time::min();
  };
  f.run(0.6, 100ms);
  CHECK(a.steps ==
        std::vector<Made>{{at(0), at(0.4), 0}, {at(0.4), at(0.5), 0}, {at(0.5), at(0.6), 0}});
  CHECK(events == 2);  // one at the start
}

TEST_CASE("a promise that ends between two points saves the steps before it") {
  IdleSystem f;
  auto& a = f.integrator("a");
  Reader b(f, "b");
  a.until = at(0.35);
  a.misbehave = [&](Time, Time to, StepResult&) {
    if (to > at(0.3)) a.until = Time::min();
  };
  f.run(0.5, 100ms);
  CHECK(a.steps ==
        std::vector<Made>{{at(0), at(0.3), 0}, {at(0.3), at(0.4), 0}, {at(0.4), at(0.5), 0}});
  CHECK(b.seen.size() == 5);
}

TEST_CASE("a unit that breaks its promise is named, with the promise and what it did") {
  IdleSystem f;
  auto& a = f.integrator("liar");
  std::string deed;
  SECTION("event") {
    a.misbehave = [](Time, Time, StepResult& result) { result.event_handling_needed = true; };
    deed = "has an event";
  }
  SECTION("early return") {
    a.misbehave = [](Time, Time, StepResult& result) {
      result.reached = at(0.25);
      result.early_return = true;
    };
    deed = "returns early at 0.25 s";
  }
  SECTION("rejection") {
    a.misbehave = [](Time from, Time, StepResult& result) {
      result = {.rejected = true, .reached = from};
    };
    deed = "rejects";
  }
  a.until = at(100);
  Reader b(f, "b");
  CHECK_THROWS_WITH(f.run(2, 100ms, 500ms),
                    Contains("unit 'liar', at 0.5 s") &&
                        Contains("promised at 0 s to be idle until 100 s") && Contains(deed));
}

TEST_CASE("when all units are suspended the run makes one step, to a point of the grid") {
  IdleSystem f;
  f.integrator("a");
  auto& b = f.integrator("b");
  b.until = at(5.25);
  Points points;
  f.options.idle.max_skip.assign(2, 2500ms);
  f.build(9, 1s).add_observer(points);
  f.simulation->run();
  CHECK(points.times == std::vector<Time>{at(0), at(2), at(3), at(5), at(6), at(7), at(8), at(9)});
}

TEST_CASE("when all units are suspended no tangent takes an input out of its deadband unseen") {
  const bool is_converted = GENERATE(false, true);
  ScriptedSystem f;
  const double deadband = is_converted ? 25.0 : 0.025;
  auto feeds = Integrator::description();
  auto follows = Integrator::description(deadband);
  if (is_converted) {
    feeds = Describe("feeds").input("u").output("y", "m").tolerance(1e-6).event_mode();
    feeds.unit("m", {.exponents = {0, 1}, .factor = 1}).promises_idle();
    follows = Describe("follows").input("u", "mm").deadband(deadband).output("y").tolerance(1e-6);
    follows.unit("mm", {.exponents = {0, 1}, .factor = 1e-3}).event_mode().promises_idle();
  }
  Integrator a(f.add("a", feeds.done()));
  Integrator b(f.add("b", follows.done()));
  f.wire("a", "y", "b", "u");
  f.options.idle.max_skip = {Duration::max(), Duration::max()};
  a.unit->number(0) = -1;
  const auto times = points(f, 0.1, 10ms);
  REQUIRE(b.steps.size() >= 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double held = -0.03 * static_cast<double>(i);
    CHECK(b.steps[i].from == at(0.03 * static_cast<double>(i)));
    CHECK(b.steps[i].to == at(0.03 * static_cast<double>(i + 1)));
    CHECK(b.steps[i].input == Approx(is_converted ? 1e3 * held : held).margin(1e-12));
  }
  CHECK(times.size() < 9);  // it still goes on to where the deadband ends
}

TEST_CASE("an input that leaves its deadband later than any time can be ends no suspension") {
  const double slope = GENERATE(1e-9, 1e-16, 1e-25, 1e-300);
  ScriptedSystem f;
  Integrator feeds(f.add("feeds", Integrator::description().done()));
  Integrator follows(f.add("follows", Integrator::description(1.0).done()));
  f.wire("feeds", "y", "follows", "u");
  f.options.idle.max_skip = {Duration::max(), Duration::max()};
  feeds.unit->number(0) = slope;
  CHECK(points(f, 0.1, 10ms) == std::vector<Time>{at(0), at(0.1)});
}

TEST_CASE("when all units are suspended no step is longer than the maximum") {
  IdleSystem f;
  f.integrator("a");
  Points points;
  f.options.idle.max_skip.assign(1, 10s);
  f.options.step.maximum = 2500ms;
  f.build(6, 1s).add_observer(points);
  f.simulation->run();
  CHECK(points.times == std::vector<Time>{at(0), at(2), at(4), at(6)});
}

TEST_CASE("a unit is suspended for one step, and not for less") {
  const bool is_enough = GENERATE(false, true);
  IdleSystem f;
  auto& a = f.integrator("a");
  a.until = is_enough ? Time(1s) : Time(1s) - Duration(1);
  f.options.idle.least = 1s;
  f.run(2, 1s);
  CHECK(f.statistics(0).suspensions == (is_enough ? 1 : 0));
}

TEST_CASE("an event of another unit ends no suspension, a message does") {
  IdleSystem f;
  const auto clocked = [](Causality causality) {
    return Describe("m").add("c", ValueType::Clock, causality).event_mode();
  };
  auto& sender = f.add("sender", clocked(Causality::Output).done());
  auto& receiver = f.add("receiver", clocked(Causality::Input).promises_idle().done());
  f.wire("sender", "c", "receiver", "c");
  std::vector<Made> steps;
  std::vector<Time> heard;
  Time now{};
  sender.on_step = [&](ScriptedUnit& self, Time, Time to) {
    StepResult result = reached(to);
    result.event_handling_needed = to == at(0.2) || to == at(0.5);
    self.clock(0) = to == at(0.5);
    now = to;
    return result;
  };
  sender.on_event = [](ScriptedUnit& self) {
    self.clock(0) = false;
    return EventResult{};
  };
  receiver.on_step = [&](ScriptedUnit&, Time from, Time to) {
    steps.push_back({from, to, 0});
    return reached(to);
  };
  receiver.on_idle_until = [](ScriptedUnit&) { return Time::max(); };
  receiver.on_set_clock = [&](ScriptedUnit&) { heard.push_back(now); };
  f.run(1, 100ms);
  CHECK(heard == std::vector<Time>{at(0.5)});
  CHECK(steps == std::vector<Made>{{at(0), at(0.5), 0}, {at(0.5), at(1), 0}});
}

TEST_CASE("a unit that catches up may end the suspension of others") {
  IdleSystem f;
  auto& a = f.integrator("a");
  auto& b = f.integrator("b");
  // a's slope is a lie by less than its tolerance, b tolerates nothing
  a.unit->on_slope = [](ScriptedUnit&, ValueReference) { return 0.0; };
  a.misbehave = [&](Time, Time, StepResult&) { a.unit->number(1) += 1e-7; };
  follow_time(f, "s", [](double t) { return t < 0.45 ? 0 : 1; });
  f.wire("s", "y", "a", "u");
  f.wire("a", "y", "b", "u");
  f.run(0.8, 100ms, 10s);
  CHECK(a.steps == std::vector<Made>{{at(0), at(0.5), 0}, {at(0.5), at(0.8), 1}});
  CHECK(b.steps == std::vector<Made>{{at(0), at(0.5), 0}, {at(0.5), at(0.8), 1e-7}});
}

TEST_CASE("a step that is cut short does not concern a suspended unit") {
  const bool rejects = GENERATE(true, false);
  IdleSystem f;
  auto& a = f.integrator("a");
  auto& c = f.add("c", Describe("c").can_save_state().may_return_early().done());
  bool cut = false;
  c.on_step = [&](ScriptedUnit&, Time from, Time to) {
    if (from != at(0.3) || std::exchange(cut, true)) return reached(to);
    if (rejects) return StepResult{.rejected = true, .reached = from};
    return StepResult{.early_return = true, .reached = at(0.35)};
  };
  Points points;
  f.options.idle.max_skip.assign(2, Duration(1s));
  f.build(0.6, 100ms).add_observer(points);
  f.simulation->run();
  CHECK(std::count(points.times.begin(), points.times.end(), at(0.35)) == 1);
  CHECK(a.steps == std::vector<Made>{{at(0), at(0.6), 0}});
}

TEST_CASE("inputs that are extrapolated leave no unit idle") {
  IdleSystem f;
  auto& a = f.integrator("a");
  f.options.extrapolation = Extrapolation::Linear;
  f.run(1, 100ms);
  CHECK(a.steps.size() == 10);
}

TEST_CASE("with threads the same units are suspended, and the results are the same") {
  const auto run = [](std::size_t threads) {
    IdleSystem f;
    f.options.threads = {threads, {}, true};
    std::vector<Integrator*> units;
    for (const char* name : {"a", "b", "c"}) units.push_back(&f.integrator(name, 0.1));
    follow_time(f, "s", [](double t) { return std::sin(3 * t); });
    f.wire("s", "y", "a", "u");
    f.wire("a", "y", "b", "u");
    f.wire("b", "y", "c", "u");
    f.run(5, 10ms, 200ms);
    std::vector<std::vector<Made>> steps;
    for (const Integrator* unit : units) steps.push_back(unit->steps);
    return steps;
  };
  const auto serial = run(1);
  CHECK(serial[0].size() < 500);
  CHECK(serial == run(3));
}
