// Nanoseconds per communication step of a ring of ten minimal units: without checks, and with so
// many of them, in turn. What counts is the ratio; the units are the cheapest there are, so it is
// the worst case.
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "master/loader/fmu/fmu.h"
#include "master/observe/checks/checks.h"
#include "master/system/scenario/check_selection.h"
#include "tests/bench/stopwatch.h"
#include "tests/build.h"

namespace {

using namespace stride;
using namespace stride::bench;

constexpr int kUnits = 10;
constexpr int kSteps = 20'000;
constexpr Duration kStep = std::chrono::milliseconds(1);

std::shared_ptr<importer::Fmu> minimal() {
  static const auto fmu = importer::Fmu::load(tests::unit_folder() / "minimal.fmu");
  return fmu;
}

core::System ring() {
  core::SystemDeclaration declaration;
  for (int i = 0; i < kUnits; ++i) {
    const std::string name = fmt::format("u{}", i);
    declaration.components.push_back({name, minimal()->description(), {}, {}});
    declaration.connections.push_back(
        {name, "y", fmt::format("u{}", (i + 1) % kUnits), "u", false, {}});
  }
  declaration.start_values = {{"u0", "y", "1", "", {}}};
  return core::System(declaration);
}

/// Ranges of the units' outputs, one after another.
std::vector<scenario::CheckDeclaration> ranges(int count) {
  std::vector<scenario::CheckDeclaration> checks;
  for (int i = 0; i < count; ++i) {
    scenario::CheckDeclaration& check = checks.emplace_back();
    check.name = fmt::format("check {}", i);
    check.subject = fmt::format("u{}.y", i % kUnits);
    check.condition.min = "-1";
    check.condition.max = "2";
  }
  return checks;
}

double run(const core::System& system, int count) {
  checks::Checks checks(scenario::select_checks(system, ranges(count), {}));
  std::vector<std::unique_ptr<core::Unit>> units;
  for (const core::Component& component : system.components()) {
    units.push_back(minimal()->instantiate(component.name));
  }
  core::RunOptions options;
  options.step.size = kStep;
  options.stop = Time(kStep * kSteps);
  options.measure_time = false;
  options.watched = checks.signals();
  core::Simulation simulation(system, std::move(units), options);
  if (!checks.is_empty()) simulation.add_observer(checks, checks.signals());
  const double seconds = time_steps(simulation);
  for (const core::Verdict& verdict : checks.verdicts({options.stop, true})) {
    if (verdict.passed != true) throw std::runtime_error(verdict.name + ": " + verdict.text);
  }
  return seconds;
}

/// Both in turn within each iteration, so that a machine that changes its speed changes it for
/// both.
void checks_on_a_ring(benchmark::State& state) {
  const core::System system = ring();
  double plain_seconds = 0;
  double checked_seconds = 0;
  for (auto _ : state) {
    plain_seconds += run(system, 0);
    const double checked = run(system, static_cast<int>(state.range(0)));
    checked_seconds += checked;
    state.SetIterationTime(checked);
  }
  const double steps = static_cast<double>(state.iterations()) * kSteps;
  state.counters["plain_ns"] = 1e9 * plain_seconds / steps;
  state.counters["checked_ns"] = 1e9 * checked_seconds / steps;
  state.counters["ratio"] = checked_seconds / plain_seconds;
}

BENCHMARK(checks_on_a_ring)->Arg(1)->Arg(20)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
