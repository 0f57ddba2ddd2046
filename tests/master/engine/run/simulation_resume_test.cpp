// Simulation::resume(): what the random systems of tests/property do not have.
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "master/base/text/hex.h"
#include "master/engine/run/simulation.h"
#include "tests/master/engine/run/cut_run.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// A scripted system, run as a whole, or cut at a time.
struct Resumed : ScriptedSystem {
  /// What observers see.
  std::string whole() { return trace({}); }
  std::string cut_at(Time time) { return trace(time); }
  RunStatistics statistics;

 private:
  std::string trace(std::optional<Time> time) {
    system = std::make_unique<System>(declaration);
    Trace trace(*system);
    CutRun run{*system, share(std::move(units)), trace};
    std::vector<std::byte> state;
    if (time) {
      state = run.up_to({*time, false}, options);
      REQUIRE_FALSE(state.empty());
    }
    statistics = run.from(state, options);
    return trace.text();
  }
};

template <class Make>
void check_same_if_cut(Make&& make, Time time) {
  Resumed whole, cut;
  make(whole);
  make(cut);
  const std::string expected = whole.whole();
  CHECK(cut.cut_at(time) == expected);
}

RunOptions steps(Duration size, Time stop, std::vector<VariableId> recorded = {}) {
  RunOptions options;
  options.step.size = size;
  options.stop = stop;
  options.recorded = std::move(recorded);
  return options;
}

auto resumable() { return Describe("io").input("u").output("y").done(); }

/// Notes what is called, and when.
struct Called : Observer {
  std::vector<std::string> calls;
  const ValueBlock* block = nullptr;
  void on_start(std::span<const Signal> signals) override {
    calls.emplace_back("start");
    if (!signals.empty()) block = signals[0].block;
  }
  void on_communication_point(Time) override { calls.emplace_back("point"); }
  void on_finish() override { calls.emplace_back("finish"); }
};

/// The state of a system of one unit at 3 ms.
std::vector<std::byte> state_of(ScriptedSystem& f, double stop = 0.01,
                                const std::vector<VariableId>& recorded = {}) {
  struct Writer : RunControl {
    Simulation* simulation = nullptr;
    StateArchive state;
    std::optional<Pause> next(Time now) override {
      return now < Time(3ms) ? std::optional(Pause{Time(3ms), false}) : std::nullopt;
    }
    void on_pause(Time) override { simulation->persist(state); }
  } writer;
  writer.simulation = &f.build(stop, 1ms, recorded);
  writer.simulation->set_control(writer);
  writer.simulation->run();
  return writer.state.bytes();
}

}  // namespace

TEST_CASE("a run that is resumed calls its units, and observes, from the next step on") {
  ScriptedSystem first;
  first.add("a", resumable());
  const std::vector<std::byte> state = state_of(first);
  ScriptedSystem f;
  auto& a = f.add("a", resumable());
  Time from = Time::max();
  a.on_step = [&](ScriptedUnit&, Time begin, Time to) {
    from = std::min(from, begin);
    return reached(to);
  };
  Called called;
  f.build(0.005, 1ms).add_observer(called);
  StateArchive archive(state);
  f.simulation->resume(archive, [&] {
    CHECK(called.calls == std::vector<std::string>{"start"});
    CHECK(a.calls.empty());
    CHECK(a.gets == 0);
    CHECK_NOTHROW(archive.end());
  });
  CHECK(from == Time(3ms));
  CHECK(called.calls == std::vector<std::string>{"start", "point", "point", "finish"});
  CHECK(a.calls == ScriptedUnit::Calls{"terminate"});
  CHECK(f.simulation->statistics().communication_steps == 5);
  CHECK(f.simulation->statistics().start == Time(0ms));
  CHECK(f.simulation->statistics().reached == Time(5ms));
}

TEST_CASE("observers see the values of the state when they have been started") {
  ScriptedSystem first;
  const auto description = Describe("io").input("u").output("y").done();
  first.add("a", description).on_initialize = [](ScriptedUnit& unit) { unit.number(1) = 4; };
  ViaDeclaration out;
  out.connector.name = "out";
  first.declaration.outputs.push_back({"a", "y", {out}});
  const System system(first.declaration);
  const auto recorded = {system.output_id(0)};
  first.options.recorded = recorded;
  struct Writer : RunControl {
    Simulation* simulation = nullptr;
    StateArchive state;
    std::optional<Pause> next(Time) override {
      return state.bytes().empty() ? std::optional(Pause{Time(3ms), false}) : std::nullopt;
    }
    void on_pause(Time) override { simulation->persist(state); }
  } writer;
  writer.simulation = &first.build(0.01, 1ms, recorded);
  writer.simulation->set_control(writer);
  writer.simulation->run();
  ScriptedSystem f;
  f.add("a", description);
  f.declaration.outputs = first.declaration.outputs;
  Called called;
  f.build(0.005, 1ms, recorded).add_observer(called);
  StateArchive archive(writer.state.bytes());
  double value = 0;
  f.simulation->resume(archive, [&] { value = called.block->numbers<double>()[0]; });
  CHECK(value == 4);
}

TEST_CASE("a run that goes on with other variables reads those that are new, once") {
  ScriptedSystem first;
  const auto description = Describe("io").input("u").output("x").output("y").done();
  first.add("a", description);
  first.add("b", description);
  const std::vector<std::byte> state = state_of(first, 0.01, {{0, 1}, {1, 2}});
  ScriptedSystem f;
  auto& a = f.add("a", description);
  auto& b = f.add("b", description);
  a.number(2) = 7;
  Called called;
  f.build(0.005, 1ms, {{0, 2}, {1, 2}}).add_observer(called);
  StateArchive archive(state);
  double value = 0;
  f.simulation->resume(archive, [&] {
    value = called.block->numbers<double>()[0];
    CHECK(a.gets == 1);
    CHECK(b.gets == 0);
    CHECK(a.calls.empty());
    CHECK_NOTHROW(archive.end());
  });
  CHECK(value == 7);
}

TEST_CASE("new outputs of a suspended unit are on their tangents, and old ones stay there") {
  const VariableId x{0, 0}, y{0, 1}, z{0, 2}, count{0, 3};
  const auto make = [](Resumed& f) {
    f.options = steps(1ms, Time(60ms));
    f.options.idle.max_skip.assign(1, 20ms);
    auto& a = f.add("a", Describe("a")
                             .output("x")
                             .tolerance(1e-6)
                             .output("y")
                             .tolerance(1e-6)
                             .output("z")
                             .tolerance(1e-6)
                             .output("count")
                             .event_mode()
                             .promises_idle()
                             .done());
    a.on_slope = [](ScriptedUnit& unit, ValueReference reference) {
      return unit.number(3) + 0.1 * (1 + static_cast<double>(reference));
    };
    a.on_step = [&slope = a.on_slope](ScriptedUnit& unit, Time from, Time to) {
      for (ValueReference k = 0; k < 3; ++k)
        unit.number(k) += slope(unit, k) * to_seconds(to - from);
      ++unit.number(3);
      return reached(to);
    };
    a.on_idle_until = [](ScriptedUnit&) { return Time::max(); };
    f.add("beside", resumable());  // is never suspended, so there is a point at each step
  };
  const auto observing = [](RunOptions options, std::vector<VariableId> ids) {
    options.recorded = std::move(ids);
    return options;
  };
  const std::vector<VariableId> after{y, z, count};
  for (const Duration cut : {0ms, 7ms, 20ms, 33ms}) {
    INFO(to_seconds(cut) << " s");
    Resumed whole, f;
    make(whole);
    make(f);
    whole.options = observing(whole.options, after);
    const std::string expected = whole.whole();
    f.system = std::make_unique<System>(f.declaration);
    Trace ignored(*f.system), trace(*f.system);
    CutRun before{*f.system, share(std::move(f.units)), ignored};
    const auto state = before.up_to({Time(cut), false}, observing(f.options, {x, y}));
    REQUIRE_FALSE(state.empty());
    CutRun{*f.system, before.units, trace}.from(state, observing(f.options, after));
    REQUIRE(trace.text().size() > 100);
    CHECK(expected.ends_with(trace.text()));
    CHECK(trace.points().front() == Time(cut + 1ms));
  }
}

TEST_CASE("statistics count the whole run, without what brought the units to where they are") {
  ScriptedSystem first;
  first.add("a", resumable()).host = HostStatistics{7, 2, 4, 100, 900};
  const std::vector<std::byte> state = state_of(first);
  ScriptedSystem f;
  auto& a = f.add("a", resumable());
  a.host = HostStatistics{10, 10, 1, 300, 500};  // in the replay
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    ++unit.host->snapshots;
    return reached(to);
  };
  f.build(0.005, 1ms);
  StateArchive archive(state);
  f.simulation->resume(archive, [] {});
  const HostStatistics host = f.simulation->statistics().units[0].host.value();
  CHECK(host.snapshots == 7 + 2);
  CHECK(host.restores == 2);
  CHECK(host.most_snapshots == 4);
  CHECK(host.most_snapshot_memory == 300);
  CHECK(host.most_memory == 900);
  CHECK(f.simulation->statistics().units[0].steps == 5);
}

TEST_CASE("wall times of a run that is resumed are those of both parts") {
  ScriptedSystem first;
  first.add("a", resumable());
  const std::vector<std::byte> state = state_of(first);
  ScriptedSystem f;
  f.add("a", resumable());
  RunStatistics earlier;
  earlier.units.resize(1);
  earlier.wall_time = 1h;
  earlier.phases = {1h, 2h, 3h, 4h};
  earlier.units[0].step_time = 2h;
  earlier.units[0].initialization_time = 3h;
  StateArchive changed;
  changed.mark("run");
  Time time(3ms);
  std::uint32_t stalled = 0;
  changed.value(time);
  changed.value(stalled);
  persist(changed, earlier);
  std::vector<std::byte> bytes = changed.bytes();
  bytes.insert(bytes.end(), state.begin() + static_cast<std::ptrdiff_t>(bytes.size()), state.end());
  f.build(0.01, 1ms);
  StateArchive archive(bytes);
  f.simulation->resume(archive, [] {});
  const RunStatistics& statistics = f.simulation->statistics();
  const auto is_little_more = [](auto whole, auto before) {
    return whole >= before && whole < before + 1h;
  };
  CHECK(is_little_more(statistics.wall_time, 1h));
  CHECK(is_little_more(statistics.phases.initialization, 1h));
  CHECK(is_little_more(statistics.phases.steps, 2h));
  CHECK(is_little_more(statistics.phases.instants, 3h));
  CHECK(is_little_more(statistics.phases.observers, 4h));
  CHECK(is_little_more(statistics.units[0].step_time, 2h));
  CHECK(is_little_more(statistics.units[0].initialization_time, 3h));
}

TEST_CASE("what is no state of the system is refused: units are terminated, observers finished") {
  ScriptedSystem first;
  first.add("a", resumable());
  std::vector<std::byte> state = state_of(first);
  ScriptedSystem f;
  auto& a = f.add("a", resumable());
  double stop = 0.01;
  std::string reason = "where there should be";
  SECTION("of another system") { f.add("b", resumable()); }
  SECTION("of a later time than the stop time") {
    stop = 0.002;
    reason = "its time is not in the run";
  }
  SECTION("cut off") {
    state.resize(state.size() - 1);
    reason = "it ends too early";
  }
  SECTION("of another policy") {
    f.options.step.policy = &kErrorControlledSteps;
    f.declaration.components[0].description =
        Describe("io").input("u").output("y").can_save_state().done();
    reason = "expected next";
  }
  Called called;
  f.build(stop, 1ms).add_observer(called);
  StateArchive archive(state);
  CHECK_THROWS_WITH(f.simulation->resume(archive, [&] { archive.end(); }), Contains(reason));
  CHECK(called.calls == std::vector<std::string>{"finish"});
  CHECK(a.calls == ScriptedUnit::Calls{"terminate"});
}

TEST_CASE("steps that end where they began are counted across a cut") {
  const auto make = [](Resumed& f) {
    f.options = steps(1ms, Time(10ms));
    f.options.step.policy = &kEventDrivenSteps;
    f.options.step.maximum = 1ms;
    f.add("a", Describe("a").output("y").may_return_early().can_save_state().done()).on_step =
        [](ScriptedUnit&, Time from, Time to) {
          if (from < Time(3ms)) return reached(to);
          StepResult result = reached(from);
          result.early_return = true;
          return result;
        };
  };
  Resumed whole, cut;
  make(whole);
  make(cut);
  const std::string expected = whole.whole();
  CHECK_THAT(expected, Contains("1000 steps in a row"));
  // some of them have been made by then
  cut.system = std::make_unique<System>(cut.declaration);
  Trace trace(*cut.system);
  CutRun run{*cut.system, share(std::move(cut.units)), trace};
  const std::vector<std::byte> state = run.up_to_point(300, cut.options);
  REQUIRE_FALSE(state.empty());
  run.from(state, cut.options);
  CHECK(trace.text() == expected);
}

TEST_CASE("the index of an instant goes on across a cut within it") {
  const auto make = [](Resumed& f) {
    f.options = steps(1ms, Time(5ms));
    auto& a = f.add("a", Describe("a")
                             .add("out.clock", ValueType::Clock, Causality::Output)
                             .add("out", ValueType::Binary, Causality::Output)
                             .clocked_by(0)
                             .event_mode()
                             .may_return_early()
                             .done());
    a.on_step = [count = 0](ScriptedUnit& unit, Time from, Time to) mutable {
      const bool stops = from == Time(2ms) && count++ < 3;
      StepResult result = reached(stops ? from : to);
      result.early_return = result.event_handling_needed = stops;
      unit.clock(0) = stops;
      return result;
    };
    a.on_event = [](ScriptedUnit& unit) {
      unit.clock(0) = false;
      return EventResult{};
    };
  };
  Resumed whole;
  make(whole);
  const std::string expected = whole.whole();
  CHECK_THAT(expected, Contains("0.002/2 a.out"));
  for (std::size_t point = 2; point < 6; ++point) {
    Resumed cut;
    make(cut);
    cut.system = std::make_unique<System>(cut.declaration);
    Trace trace(*cut.system);
    CutRun run{*cut.system, share(std::move(cut.units)), trace};
    const std::vector<std::byte> state = run.up_to_point(point, cut.options);
    run.from(state, cut.options);
    CHECK(trace.text() == expected);
  }
}

TEST_CASE("messages are corrupted, and delayed, alike across a cut") {
  const auto kind = GENERATE(Intervention::Kind::Corrupt, Intervention::Kind::Delay);
  const auto make = [kind](Resumed& f) {
    f.options = steps(1ms, Time(10ms));
    auto& a = f.add("a", Describe("a")
                             .add("out.clock", ValueType::Clock, Causality::Output)
                             .add("out", ValueType::Binary, Causality::Output)
                             .clocked_by(0)
                             .event_mode()
                             .done());
    f.add("b", Describe("b")
                   .add("in.clock", ValueType::Clock, Causality::Input)
                   .add("in", ValueType::Binary, Causality::Input)
                   .clocked_by(0)
                   .event_mode()
                   .done());
    f.wire("a", "out.clock", "b", "in.clock");
    f.wire("a", "out", "b", "in");
    a.on_step = [](ScriptedUnit& unit, Time, Time to) {
      StepResult result = reached(to);
      result.event_handling_needed = unit.clock(0) = true;
      unit.binary(1).assign(8, static_cast<std::uint8_t>(to.time_since_epoch() / 1ms));
      return result;
    };
    a.on_event = [](ScriptedUnit& unit) {
      unit.clock(0) = false;
      return EventResult{};
    };
    Intervention intervention{kind, {1, 0}, Time(2ms), Time(8ms)};
    intervention.clock = {1, 0};
    intervention.bits = 3;
    intervention.delay = 2500us;
    f.options.interventions.push_back(intervention);
  };
  check_same_if_cut(make, Time(5ms));
  check_same_if_cut(make, Time(2ms));
  check_same_if_cut(make, Time(9ms));
}

TEST_CASE("values of all types are those of the state") {
  const auto types = {ValueType::Float32, ValueType::Float64, ValueType::Int8,
                      ValueType::UInt16,  ValueType::Int32,   ValueType::UInt64,
                      ValueType::Boolean, ValueType::String,  ValueType::Binary};
  for (const ValueType type : types) {
    INFO(name(type));
    const auto make = [type](Resumed& f) {
      f.options = steps(1ms, Time(8ms), {{0, 0}, {1, 0}});
      const auto with = [type](Causality causality) {
        return Describe("unit").add("v", type, causality).size(2).event_mode().done();
      };
      auto& a = f.add("a", with(Causality::Output));
      auto& b = f.add("b", with(Causality::Input));
      f.wire("a", "v", "b", "v");
      a.on_step = [](ScriptedUnit& unit, Time, Time to) {
        visit(unit.block(0), [&]<class T>(std::span<T> elements) {
          const auto count = static_cast<int>(to.time_since_epoch() / 3ms);
          if constexpr (std::is_arithmetic_v<T>) {
            elements[1] = static_cast<T>(count);
          } else {
            elements[1].assign(static_cast<std::size_t>(count), 'x');
          }
        });
        return reached(to);
      };
      b.on_event = [](ScriptedUnit&) { return EventResult{}; };
    };
    for (const Duration cut : {1ms, 2ms, 3ms, 4ms}) check_same_if_cut(make, Time(cut));
  }
}
