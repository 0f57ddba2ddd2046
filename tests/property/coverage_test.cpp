// What a component was given is counted alike in a run and in a replay to it alone, in this
// process, in others and on threads.
#include "master/observe/coverage/coverage.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "master/observe/capture/capture.h"
#include "master/system/scenario/coverage_selection.h"
#include "tests/property/random_system.h"
#include "tests/property/replays.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using scenario::PointKind;

namespace {

const unsigned kCoverageSystems = kSanitized ? 8 : 60;
constexpr Duration kCoverageStep = 1ms;
constexpr Time kCoverageStop{100ms};

/// Points of all inputs of a component, and a cross of two of them.
scenario::GroupDeclaration covered_inputs(const Assembly& system, const std::string& component) {
  scenario::GroupDeclaration group{.component = component};
  std::vector<std::string> values;
  for (const auto& declared : system.declaration().components) {
    if (declared.name != component) continue;
    const core::UnitDescription& unit = *declared.description;
    for (const core::Variable& variable : unit.variables) {
      if (variable.causality != core::Causality::Input || variable.size != 1) continue;
      if (variable.type == core::ValueType::Clock) continue;
      const bool is_real = core::is_real(variable.type);
      if (unit.is_message(variable)) {
        group.points.push_back({.kind = PointKind::Gaps, .subject = variable.name});
        if (is_real) continue;
        group.points.push_back({.kind = PointKind::Words, .subject = variable.name});
        group.points.push_back({.kind = PointKind::Sequences, .subject = variable.name});
      } else if (is_real) {
        group.points.push_back({.kind = PointKind::Values, .subject = variable.name});
        group.points.back().edges = {-1e3, -10, -1,  -0.3, -0.1, -0.01, 0,
                                     0.01, 0.1, 0.3, 1,    10,   1e3};
        values.push_back(variable.name);
      }
    }
  }
  if (values.size() > 1)
    group.points.push_back({.kind = PointKind::Cross, .of = {values[0], values[1]}});
  return group;
}

coverage::Report covered_run(const Assembly& assembly, const scenario::GroupDeclaration& group,
                             core::RunOptions options,
                             const std::vector<capture::CaptureRequest>& captures = {}) {
  const core::System system(assembly.declaration());
  coverage::Coverage coverage(scenario::select_coverage(system, std::vector{group}, {}).groups);
  options.watched = coverage.signals();
  capture::Capture capture(system, "assembly", options, captures);
  auto units = assembly.instantiate();
  capture.wrap(units, options);
  core::Simulation simulation(system, std::move(units), options);
  capture.follow(simulation);
  coverage.follow(simulation);
  simulation.add_observer(coverage, coverage.signals());
  simulation.add_observer(capture);
  simulation.run();
  capture.end("completed");
  return coverage.report("assembly");
}

std::string coverage_text(const coverage::Report& report) {
  std::string text;
  for (const coverage::PointReport& point : report.groups.at(0).points) {
    text += point.name + ":";
    for (const coverage::BinCount& bin : point.bins) {
      if (bin.count > 0) {
        text += " " + bin.name + " " + std::to_string(bin.count) + " at " +
                std::to_string(bin.first.value());
      }
    }
    text += "\n";
  }
  return text;
}

std::size_t visit_count(const coverage::Report& report) {
  std::size_t count = 0;
  for (const coverage::PointReport& point : report.groups.at(0).points) {
    for (const coverage::BinCount& bin : point.bins) count += bin.count;
  }
  return count;
}

/// `max_skip`: of the component, in both runs.
void check_covered_replay(const Assembly& system, const std::string& component,
                          core::RunOptions options, std::size_t& seen,
                          std::optional<Duration> max_skip = std::nullopt) {
  const scenario::GroupDeclaration group = covered_inputs(system, component);
  if (group.points.empty()) return;
  const Scratch scratch;
  const coverage::Report original =
      covered_run(system, group, std::move(options), {{component, scratch / "stimuli.csv"}});
  const Assembly only = alone(system, component, player_of(scratch, scratch / "stimuli.csv"));
  core::RunOptions replay = fixed_steps(kCoverageStop.time_since_epoch(), kCoverageStop);
  replay.idle = {{std::nullopt, max_skip}, {}, {}, kCoverageStop.time_since_epoch()};
  CHECK(coverage_text(covered_run(only, group, replay)) == coverage_text(original));
  seen += visit_count(original);
}

}  // namespace

TEST_CASE("a replay covers the same of a component's inputs") {
  std::size_t seen = 0;
  for (unsigned seed = 0; seed < kCoverageSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const auto& components = system.declaration().components;
    const std::string& component = components[seed % components.size()].name;
    INFO("seed " << seed << ", " << component << "\n" << system.text());
    check_covered_replay(system, component, fixed_steps(kCoverageStep, kCoverageStop), seen);
  }
  CHECK(seen > 5 * kCoverageSystems);
}

TEST_CASE("a replay covers the same where the component was suspended") {
  const auto max_skip = GENERATE(Duration(2ms), Duration(7ms), Duration(1s));
  Assembly system;
  system.add("pump", "ticker", {{"period", "0.006"}});
  system.add("clock", "ticker", {{"period", "0.0031"}, {"announces", "1"}});
  system.add("tank", "idler",
             {{"rate", "5"}, {"period", "0.0215"}, {"announces", "1"}, {"inflow", "0"}});
  system.wire("pump.level", "tank.inflow").wire("clock.tick.clock", "tank.ask");
  core::RunOptions options = fixed_steps(kCoverageStep, kCoverageStop);
  options.idle.max_skip.assign(3, max_skip);
  options.idle.least = kCoverageStep;
  std::size_t seen = 0;
  check_covered_replay(system, "tank", options, seen, max_skip);
  CHECK(seen > 5);
}

TEST_CASE(
    "what an input does within its deadband, while the component is suspended, is not counted") {
  Assembly system;
  system.add("wave", "linear", {{"frequency", "200"}, {"damping", "0"}, {"x", "0.35"}});
  system.add("tank", "idler", {{"rate", "5"}, {"period", "0.0215"}, {"announces", "1"}});
  system.wire("wave.x", "tank.inflow");
  core::RunOptions options = fixed_steps(kCoverageStep, kCoverageStop);
  options.idle.max_skip = {std::nullopt, Duration(1s)};
  options.idle.least = kCoverageStep;
  const core::UnitDescription& tank = *system.declaration().components[1].description;
  options.idle.deadbands = {{{1, tank.find("inflow").value()}, 0.2}};
  std::size_t seen = 0;
  check_covered_replay(system, "tank", options, seen, Duration(1s));
  CHECK(seen > 5);
}

TEST_CASE("threads and hosts change nothing of what is covered") {
  for (unsigned seed = 0; seed < kCoverageSystems / 10 + 1; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const auto& components = system.declaration().components;
    const scenario::GroupDeclaration group =
        covered_inputs(system, components[seed % components.size()].name);
    if (group.points.empty()) continue;
    core::RunOptions options = fixed_steps(kCoverageStep, kCoverageStop);
    const std::string expected = coverage_text(covered_run(system, group, options));
    CHECK(coverage_text(covered_run(system.hosted(), group, options)) == expected);
    options.threads = {.count = 3, .always = true};
    CHECK(coverage_text(covered_run(system, group, options)) == expected);
  }
}
