// Nanoseconds per unit step for rings of minimal units, each fed by its neighbour: stride's
// algorithm beside a hand-written loop that makes the same FMI calls, in turn, in one run. What
// counts is the ratio.
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "master/loader/fmu/fmu.h"
#include "tests/bench/stopwatch.h"
#include "tests/build.h"

namespace {

using namespace stride;
using namespace stride::bench;

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr int kUnitSteps = 200'000;  // per measured run, whatever the size of the ring

std::shared_ptr<importer::Fmu> minimal() {
  static const auto fmu = importer::Fmu::load(tests::unit_folder() / "minimal.fmu");
  return fmu;
}

double run_stride(int size) {
  core::SystemDeclaration declaration;
  for (int i = 0; i < size; ++i) {
    declaration.components.push_back({fmt::format("u{}", i), minimal()->description(), {}, {}});
    declaration.connections.push_back(
        {fmt::format("u{}", i), "y", fmt::format("u{}", (i + 1) % size), "u", false, {}});
  }
  declaration.start_values = {{"u0", "y", "1", "", {}}};
  const core::System system(declaration);
  std::vector<std::unique_ptr<core::Unit>> units;
  for (const core::Component& component : system.components()) {
    units.push_back(minimal()->instantiate(component.name));
  }
  core::RunOptions options;
  options.step.size = kStep;
  options.stop = Time(kStep * (kUnitSteps / size));
  options.measure_time = false;
  core::Simulation simulation(system, std::move(units), options);
  return time_steps(simulation);
}

double run_by_hand(int size) {
  const auto library = minimal()->load_fmi3_library();
  const importer::Fmi3Functions& fmi = library->functions();
  const auto& description = *minimal()->description();
  const fmi3ValueReference u = description.variables[*description.find("u")].reference;
  const fmi3ValueReference y = description.variables[*description.find("y")].reference;
  std::vector<fmi3Instance> units;
  for (int i = 0; i < size; ++i) {
    units.push_back(fmi.InstantiateCoSimulation("u", description.instantiation_token.c_str(),
                                                nullptr, false, false, false, false, nullptr, 0,
                                                nullptr, nullptr, nullptr));
    const double start = i == 0 ? 1 : 0;
    fmi.SetFloat64(units.back(), &y, 1, &start, 1);
    fmi.EnterInitializationMode(units.back(), false, 0, 0, false, 0);
    fmi.ExitInitializationMode(units.back());
  }
  const auto count = static_cast<std::size_t>(size);
  std::vector<double> outputs(count);
  const double h = to_seconds(kStep);
  const auto began = Wall::now();
  for (int step = 0; step < kUnitSteps / size; ++step) {
    for (std::size_t i = 0; i < count; ++i) {
      bool event = false;
      bool terminate = false;
      bool early = false;
      double reached = 0;
      fmi.DoStep(units[i], to_seconds(kStep * step), h, true, &event, &terminate, &early, &reached);
    }
    for (std::size_t i = 0; i < count; ++i) fmi.GetFloat64(units[i], &y, 1, &outputs[i], 1);
    for (std::size_t i = 0; i < count; ++i) {
      fmi.SetFloat64(units[(i + 1) % count], &u, 1, &outputs[i], 1);
    }
  }
  const double seconds = seconds_since(began);
  for (const fmi3Instance unit : units) fmi.FreeInstance(unit);
  return seconds;
}

/// Both in turn within each iteration, so that a machine that changes its speed changes it for
/// both.
void ring(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  double stride_seconds = 0;
  double hand_seconds = 0;
  for (auto _ : state) {
    const double mine = run_stride(size);
    hand_seconds += run_by_hand(size);
    stride_seconds += mine;
    state.SetIterationTime(mine);
  }
  const double unit_steps = static_cast<double>(state.iterations()) * kUnitSteps;
  state.counters["stride_ns"] = 1e9 * stride_seconds / unit_steps;
  state.counters["by_hand_ns"] = 1e9 * hand_seconds / unit_steps;
  state.counters["ratio"] = stride_seconds / hand_seconds;
}

BENCHMARK(ring)->Arg(1)->Arg(2)->Arg(10)->Arg(100)->Arg(1000)->UseManualTime()->Unit(
    benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
