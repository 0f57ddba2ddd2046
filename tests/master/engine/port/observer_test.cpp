#include "master/engine/port/observer.h"

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using Kind = Activity::Kind;

namespace {

using stride::tests::at;

struct Watcher : Observer {
  std::vector<Activity> activities;
  bool watches_activities() const override { return true; }
  void on_activity(const Activity& activity) override { activities.push_back(activity); }
};

/// Asks how long units have rested so far.
struct Meter : Observer {
  const Simulation* simulation = nullptr;
  std::vector<Duration> rested;
  void on_communication_point(Time) override { rested.push_back(simulation->suspended_time()); }
};

Describe saving_integrator() {
  return Describe("integrator").input("u").output("y").can_save_state();
}

StepResult stop_at(Time stop, Time from, Time to) {
  StepResult result = reached(from < stop && stop < to ? stop : to);
  result.early_return = result.reached != to;
  return result;
}

/// Rests from the start, 0.4 s at a time.
ScriptedUnit& add_idler(ScriptedSystem& system, const std::string& name) {
  auto& unit = system.add(name, Describe("idler").output("y").tolerance(1).promises_idle().done());
  unit.on_idle_until = [](ScriptedUnit&) { return Time::max(); };
  return unit;
}

void let_rest(ScriptedSystem& system) {
  system.options.idle.max_skip.assign(system.declaration.components.size(), Duration(400ms));
}

void use_threads(ScriptedSystem& system, std::size_t count) {
  system.options.threads.count = count;
  system.options.threads.always = true;
}

std::vector<Activity> run(ScriptedSystem& system, double stop, bool fails = false) {
  Watcher watcher;
  system.build(stop, 100ms).add_observer(watcher);
  if (fails) {
    CHECK_THROWS_AS(system.simulation->run(), Error);
  } else {
    system.simulation->run();
  }
  return watcher.activities;
}

}  // namespace

TEST_CASE("an early return is reported, and the steps that were undone for it") {
  ScriptedSystem f;
  f.add("a", saving_integrator().done());
  f.add("b", saving_integrator().may_return_early().done()).on_step =
      [](ScriptedUnit&, Time from, Time to) { return stop_at(at(0.13), from, to); };
  use_threads(f, GENERATE(1, 2));
  CHECK(run(f, 0.2) == std::vector<Activity>{{1, Kind::EarlyReturn, at(0.1), at(0.13)},
                                             {0, Kind::Undone, at(0.1), at(0.2)}});
}

TEST_CASE("a rejection is reported with the end of the requested step") {
  ScriptedSystem f;
  f.add("a", saving_integrator().done()).on_step = [](ScriptedUnit&, Time from, Time to) {
    StepResult result = reached(to);
    result.rejected = from < at(0.12) && at(0.12) < to;
    if (result.rejected) result.reached = at(0.12);
    return result;
  };
  CHECK(run(f, 0.2) == std::vector<Activity>{{0, Kind::Rejection, at(0.1), at(0.2)}});
}

TEST_CASE("steps that are undone because of an input's error are reported for each unit") {
  ScriptedSystem f;
  f.add("a", saving_integrator().done()).on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(1) = to_seconds(to) * to_seconds(to) * 1e3;
    return reached(to);
  };
  f.add("b", saving_integrator().done());
  f.wire("a", "y", "b", "u");
  f.options.step.policy = &kErrorControlledSteps;
  const std::vector<Activity> told = run(f, 0.2);
  const auto undone = f.simulation->statistics().undone_steps;
  REQUIRE(undone > 0);
  CHECK(told.size() == 2 * undone);
  for (std::size_t i = 0; i < told.size(); ++i) {
    CHECK(told[i].component == i % 2);
    CHECK(told[i].kind == Kind::Undone);
    CHECK(told[i].from < told[i].until);
  }
}

TEST_CASE("Event Mode is reported once each time that a unit is in it") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("ticker").output("y").event_mode().done());
  a.on_event = [times = 0](ScriptedUnit&) mutable {
    EventResult result;
    result.discrete_states_need_update = ++times % 2 == 1;  // two iterations each time
    if (times < 4) result.next_event_time = at(0.05);
    return result;
  };
  CHECK(run(f, 0.2) == std::vector<Activity>{{0, Kind::Event, at(0), at(0)},
                                             {0, Kind::Event, at(0.05), at(0.05)}});
}

TEST_CASE("a suspension is reported where it ends, whatever ends it and on whatever thread") {
  ScriptedSystem f;
  add_idler(f, "a");
  f.add("b", saving_integrator().done());
  add_idler(f, "c");
  let_rest(f);
  use_threads(f, GENERATE(1, 3));
  CHECK(run(f, 1) == std::vector<Activity>{{0, Kind::Idle, at(0), at(0.4)},
                                           {2, Kind::Idle, at(0), at(0.4)},
                                           {0, Kind::Idle, at(0.4), at(0.8)},
                                           {2, Kind::Idle, at(0.4), at(0.8)},
                                           {0, Kind::Idle, at(0.8), at(1)},
                                           {2, Kind::Idle, at(0.8), at(1)}});
}

TEST_CASE("a suspension that a step ends is reported once, by the thread of the simulation") {
  ScriptedSystem f;
  add_idler(f, "a");
  add_idler(f, "b");
  f.add("c", saving_integrator().done());
  let_rest(f);
  use_threads(f, GENERATE(1, 3));
  Watcher watcher;
  f.build(0.9, 300ms).add_observer(watcher);
  f.simulation->run();
  CHECK(watcher.activities == std::vector<Activity>{{0, Kind::Idle, at(0), at(0.3)},
                                                    {1, Kind::Idle, at(0), at(0.3)},
                                                    {0, Kind::Idle, at(0.6), at(0.9)},
                                                    {1, Kind::Idle, at(0.6), at(0.9)}});
}

TEST_CASE("suspensions that a failure ends are reported, too") {
  ScriptedSystem f;
  add_idler(f, "a");
  f.add("b", saving_integrator().done()).on_step = [](ScriptedUnit&, Time, Time to) -> StepResult {
    if (to > at(0.6)) fail_run({}, "broken");
    return reached(to);
  };
  let_rest(f);
  CHECK(run(f, 1, true) ==
        std::vector<Activity>{{0, Kind::Idle, at(0), at(0.4)}, {0, Kind::Idle, at(0.4), at(0.6)}});
}

TEST_CASE("activities are not reported to observers that do not watch them") {
  ScriptedSystem f;
  f.add("a", Describe("ticker").output("y").event_mode().done());
  struct Uninterested : Watcher {
    bool watches_activities() const override { return false; }
  } uninterested;
  f.build(0.2, 100ms).add_observer(uninterested);
  f.simulation->run();
  CHECK(uninterested.activities.empty());
}

TEST_CASE("the time of suspensions that still last is counted during the run") {
  ScriptedSystem f;
  add_idler(f, "a");
  f.add("b", saving_integrator().done());
  let_rest(f);
  Meter meter;
  f.build(0.6, 100ms).add_observer(meter);
  meter.simulation = f.simulation.get();
  f.simulation->run();
  CHECK(meter.rested == std::vector<Duration>{0ms, 100ms, 200ms, 300ms, 400ms, 500ms, 600ms});
  CHECK(f.simulation->suspended_time() == Duration(600ms));
}
