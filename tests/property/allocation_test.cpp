// The whole loop takes nothing from the heap: exchange, steps, saved states, early returns, events
// and messages.
#include <string>

#include <catch2/catch.hpp>

#include "master/observe/checks/checks.h"
#include "master/observe/coverage/coverage.h"
#include "master/system/scenario/check_selection.h"
#include "master/system/scenario/coverage_selection.h"
#include "tests/counting_allocator.h"
#include "tests/property/assembly.h"

namespace {

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

constexpr Time kWarm{100ms};  // by then each kind of step and event has been there

/// Counts from kWarm on.
struct AllocationCounter : core::Observer {
  long at_start = 0;
  long at_warm = 0;
  long last = 0;
  std::uint64_t points = 0;
  std::uint64_t messages = 0;
  void on_start(std::span<const core::Signal>) override { at_start = allocations; }
  void on_message(const core::Message& message) override { messages += message.time > kWarm; }
  void on_communication_point(Time time) override {
    if (time <= kWarm) at_warm = allocations;
    last = allocations;
    points += time > kWarm;
  }
};

/// Ten units, each fed by its neighbour.
Assembly ring() {
  Assembly system;
  for (int i = 0; i < 10; ++i) system.add("r" + std::to_string(i), "linear");
  for (int i = 0; i < 10; ++i) {
    system.wire("r" + std::to_string(i) + ".x", "r" + std::to_string((i + 1) % 10) + ".u");
  }
  return system;
}

core::RunStatistics run_counted(const Assembly& assembly, AllocationCounter& counter,
                                const core::IdleOptions& idle = {},
                                core::Extrapolation extrapolation = core::Extrapolation::Hold) {
  const core::System system(assembly.declaration());
  core::RunOptions options = fixed_steps(1ms, Time(1s));
  options.idle = idle;
  options.extrapolation = extrapolation;
  core::Simulation simulation(system, assembly.instantiate(), options);
  simulation.add_observer(counter);
  simulation.run();
  return simulation.statistics();
}

}  // namespace

TEST_CASE("a ring of ten in fixed steps does not allocate") {
  AllocationCounter counter;
  run_counted(ring(), counter);
  CHECK(counter.points == 900);
  CHECK(counter.last - counter.at_warm == 0);
  CHECK(counter.at_start > 100);  // the counting works
}

TEST_CASE(
    "a ring does not allocate beside units that return early, announce events and send messages") {
  Assembly system = ring();
  system.add("finds", "ticker", {{"period", "0.0047"}, {"announces", "0"}})
      .add("announces", "ticker", {{"period", "0.0033"}})
      .add("listener", "listener")
      .add("stops", "early", {{"instants", "0.05 0.2 0.3 0.4 0.5 0.6 0.7 0.8"}})
      .wire("r3.x", "stops.u")
      .wire_message("finds.tick", "listener.message");
  AllocationCounter counter;
  const core::RunStatistics statistics = run_counted(system, counter);
  CHECK(counter.messages > 300);
  CHECK(counter.last - counter.at_warm == 0);
  std::uint64_t saves = 0;
  std::uint64_t rollbacks = 0;
  for (const core::UnitStatistics& unit : statistics.units) {
    saves += unit.saves;
    rollbacks += unit.rollbacks;
  }
  CHECK(saves > 1'000);
  CHECK(rollbacks > 100);
}

TEST_CASE("a system does not allocate where checks watch signals and messages") {
  using scenario::CheckDeclaration;
  Assembly assembly = ring();
  assembly.add("ticker", "ticker", {{"period", "0.0047"}}).add("listener", "listener");
  assembly.wire_message("ticker.tick", "listener.message");
  std::vector<CheckDeclaration> declared{{checks::Kind::Always, "bounded", "*.x"},
                                         {checks::Kind::Count, "ticks", "ticker.tick.number"},
                                         {checks::Kind::Answer, "heard", "ticker.tick.number"}};
  declared[0].condition.max = "1e9";
  declared[1].max = 1'000'000;
  declared[2].reply = "listener.message.number";
  const core::System system(assembly.declaration());
  checks::Checks checks(scenario::select_checks(system, declared, {}));
  core::RunOptions options = fixed_steps(1ms, Time(1s));
  options.watched = checks.signals();
  core::Simulation simulation(system, assembly.instantiate(), options);
  AllocationCounter counter;
  simulation.add_observer(checks, checks.signals());
  simulation.add_observer(counter);
  simulation.run();
  for (const core::Verdict& verdict : checks.verdicts({Time(1s), true})) {
    CHECK(verdict.passed == true);
  }
  CHECK(counter.messages > 300);
  CHECK(counter.last - counter.at_warm == 0);
}

TEST_CASE("a system does not allocate where values and messages are covered") {
  using scenario::PointKind;
  Assembly assembly = ring();
  assembly.add("ticker", "ticker", {{"period", "0.0047"}}).add("listener", "listener");
  assembly.wire_message("ticker.tick", "listener.message");
  scenario::GroupDeclaration ring_group{.component = "r0"};
  ring_group.points = {
      {.kind = PointKind::Values, .name = "in", .subject = "u", .edges = {-9, -1e-3, 0, 1e-3, 9}},
      {.kind = PointKind::Values, .name = "out", .subject = "x", .edges = {-9, 0, 9}},
      {.kind = PointKind::Cross, .of = {"in", "out"}}};
  scenario::GroupDeclaration listener{.component = "listener"};
  listener.points = {{.kind = PointKind::Gaps, .subject = "message.number"}};
  const core::System system(assembly.declaration());
  coverage::Coverage coverage(
      scenario::select_coverage(system, std::vector{ring_group, listener}, {}).groups);
  core::RunOptions options = fixed_steps(1ms, Time(1s));
  options.watched = coverage.signals();
  core::Simulation simulation(system, assembly.instantiate(), options);
  AllocationCounter counter;
  coverage.follow(simulation);
  simulation.add_observer(coverage, coverage.signals());
  simulation.add_observer(counter);
  simulation.run();
  const coverage::Report report = coverage.report("ring");
  CHECK(report.groups[0].points[0].covered() > 0);
  CHECK(report.groups[1].points[0].covered() > 0);
  CHECK(counter.messages > 300);
  CHECK(counter.last - counter.at_warm == 0);
}

TEST_CASE("a system does not allocate where units are suspended") {
  Assembly system = ring();
  system.add("idler", "idler", {{"rate", "0.1"}, {"period", "0.05"}, {"announces", "1"}});
  AllocationCounter counter;
  core::IdleOptions idle;
  idle.max_skip.assign(11, Duration(10ms));
  const core::RunStatistics statistics = run_counted(system, counter, idle);
  CHECK(statistics.units.back().suspensions > 50);
  CHECK(counter.last - counter.at_warm == 0);
}

TEST_CASE("units of FMI 2.0 do not allocate, saved before each step, with derivatives of inputs") {
  Assembly system = ring();
  system.add("turns", "fmi2_turner", {{"turn", "0.0505"}})
      .add("relaxation", "fmi2_relaxation")
      .add("sum", "fmi2_integrator")
      .add("types", "fmi2_types")
      .wire("r3.x", "relaxation.u")
      .wire("relaxation.x", "sum.u")
      .wire("turns.y", "types.real");
  AllocationCounter counter;
  const core::RunStatistics statistics =
      run_counted(system, counter, {}, core::Extrapolation::Quadratic);
  CHECK(statistics.units[10].rejections == 1);
  CHECK(counter.points == 900);
  CHECK(counter.last - counter.at_warm == 0);
}
