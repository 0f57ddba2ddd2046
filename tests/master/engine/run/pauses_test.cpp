#include "master/engine/run/pauses.h"

#include <csignal>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "master/base/state_archive.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

/// Pauses as they are listed.
struct ListedPauses : RunControl {
  std::vector<Pause> list;
  std::vector<Time> asked, paused, interrupted;
  std::function<void(Time)> act = [](Time) {};

  std::optional<Pause> next(Time now) override {
    asked.push_back(now);
    if (paused.size() == list.size()) return std::nullopt;
    return list[paused.size()];
  }
  void on_pause(Time now) override {
    paused.push_back(now);
    act(now);
  }
  void on_interruption(Time now) override {
    interrupted.push_back(now);
    act(now);
  }
};

struct Pausing : ScriptedSystem {
  ListedPauses control;

  Simulation& prepared(std::vector<Pause> list, double stop = 0.01, Duration step = 1ms) {
    control.list = std::move(list);
    build(stop, step).set_control(control);
    return *simulation;
  }
};

using Times = std::vector<Time>;

auto quiet() { return Describe("quiet").input("u").output("y").done(); }

}  // namespace

TEST_CASE("a run pauses at the first communication point at or behind a time") {
  Pausing f;
  f.add("a", quiet());
  f.prepared({{Time(0ms), false}, {Time(2ms), false}, {Time(2500us), false}, {Time(10ms), false}})
      .run();
  CHECK(f.control.paused == Times{Time(0ms), Time(2ms), Time(3ms), Time(10ms)});
  CHECK(f.control.asked == Times{Time(0ms), Time(0ms), Time(2ms), Time(3ms), Time(10ms)});
}

TEST_CASE("a run pauses where the next step would reach a time") {
  Pausing f;
  f.add("a", quiet());
  f.prepared({{Time(2ms), true}, {Time(2500us), true}, {Time(9ms), true}, {Time(11ms), true}})
      .run();
  CHECK(f.control.paused == Times{Time(1ms), Time(2ms), Time(8ms)});
}

TEST_CASE("several pauses at one point follow each other, and one in the past is due at once") {
  Pausing f;
  f.add("a", quiet());
  f.prepared({{Time(3ms), false}, {Time(3ms), false}, {Time(1ms), true}, {Time(5ms), true}}).run();
  CHECK(f.control.paused == Times{Time(3ms), Time(3ms), Time(3ms), Time(4ms)});
}

TEST_CASE("there is no pause behind the end that a unit requests") {
  Pausing f;
  f.add("a", quiet()).on_step = [](ScriptedUnit&, Time, Time to) {
    StepResult result = reached(to);
    result.terminate_simulation = to >= Time(4ms);
    return result;
  };
  f.prepared({{Time(3ms), false}, {Time(4ms), false}}).run();
  CHECK(f.control.paused == Times{Time(3ms)});
}

TEST_CASE("where a run is interrupted, its state can be written before its units are terminated") {
  Pausing f;
  volatile std::sig_atomic_t interrupted = 0;
  f.options.interrupted = &interrupted;
  auto& a = f.add("a", quiet());
  a.on_step = [&](ScriptedUnit&, Time, Time to) {
    interrupted = to >= Time(4ms);
    return reached(to);
  };
  bool was_terminated = false;
  a.on_terminate = [&](ScriptedUnit&) { was_terminated = true; };
  std::size_t size = 0;
  f.control.act = [&](Time) {
    CHECK_FALSE(was_terminated);
    StateArchive state;
    f.simulation->persist(state);
    size = state.bytes().size();
  };
  f.prepared({}).run();
  CHECK(f.control.interrupted == Times{Time(4ms)});
  CHECK(size > 0);
  CHECK(was_terminated);
}

TEST_CASE("a state is written, and something added, in a pause only") {
  Pausing f;
  f.add("a", quiet());
  Simulation& simulation = f.prepared({{Time(3ms), false}});
  StateArchive state;
  CHECK_THROWS_AS(simulation.persist(state), std::logic_error);
  CHECK_THROWS_AS(simulation.add_interventions({}), std::logic_error);
  f.control.act = [&](Time now) {
    StateArchive read(state.bytes());
    CHECK_THROWS_AS(simulation.persist(read), std::logic_error);
    ValueBlock value(ValueType::Float64, 1);
    Intervention late{Intervention::Kind::Set, {0, 0}, now, {}, value};
    CHECK_THROWS_AS(simulation.add_interventions({late}), std::logic_error);
    late.from = now + Duration(1);
    CHECK_NOTHROW(simulation.add_interventions({late}));
  };
  Points points;
  simulation.add_observer(points);
  simulation.run();
  CHECK(points.times[4] == Time(3ms) + Duration(1));
  CHECK_THROWS_AS(simulation.persist(state), std::logic_error);
}

TEST_CASE("what a pause throws ends the run, and its units are terminated") {
  Pausing f;
  auto& a = f.add("a", quiet());
  bool was_terminated = false;
  a.on_terminate = [&](ScriptedUnit&) { was_terminated = true; };
  f.control.act = [](Time) { throw std::runtime_error("enough"); };
  CHECK_THROWS_WITH(f.prepared({{Time(3ms), false}}).run(), "enough");
  CHECK(was_terminated);
  CHECK(f.simulation->statistics().reached == Time(3ms));
}
