// Nanoseconds per connection for 10,000 connections: a hundred units with a hundred inputs each,
// every one from another unit, beside a hand-written loop that makes the same FMI calls and copies
// the same values. What counts is the ratio.
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
constexpr std::size_t kWidth = 100;              // of the unit `wide`
constexpr std::size_t kConnections = 2'000'000;  // per measured run, whatever the number of units

std::shared_ptr<importer::Fmu> wide() {
  static const auto fmu = importer::Fmu::load(tests::test_unit_folder() / "wide.fmu");
  return fmu;
}

/// Which unit feeds input `k` of unit `i`, by its output `k`.
std::size_t source(std::size_t i, std::size_t k, std::size_t units) { return (i + k + 1) % units; }

double run_stride(std::size_t units, std::size_t steps) {
  core::SystemDeclaration declaration;
  for (std::size_t i = 0; i < units; ++i) {
    declaration.components.push_back({fmt::format("u{}", i), wide()->description(), {}, {}});
    for (std::size_t k = 0; k < kWidth; ++k) {
      declaration.connections.push_back({fmt::format("u{}", source(i, k, units)),
                                         fmt::format("y[{}]", k + 1),
                                         fmt::format("u{}", i),
                                         fmt::format("u[{}]", k + 1),
                                         false,
                                         {}});
    }
  }
  const core::System system(declaration);
  std::vector<std::unique_ptr<core::Unit>> instances;
  for (const core::Component& component : system.components()) {
    instances.push_back(wide()->instantiate(component.name));
  }
  core::RunOptions options;
  options.step.size = kStep;
  options.stop = Time(kStep * static_cast<std::int64_t>(steps));
  options.measure_time = false;
  core::Simulation simulation(system, std::move(instances), options);
  return time_steps(simulation);
}

std::vector<fmi3ValueReference> references(const std::string& name) {
  const core::UnitDescription& description = *wide()->description();
  std::vector<fmi3ValueReference> found;
  for (std::size_t k = 1; k <= kWidth; ++k) {
    const auto place = description.find(fmt::format("{}[{}]", name, k));
    found.push_back(description.variables[place.value()].reference);
  }
  return found;
}

double run_by_hand(std::size_t units, std::size_t steps) {
  const auto library = wide()->load_fmi3_library();
  const importer::Fmi3Functions& fmi = library->functions();
  const std::vector<fmi3ValueReference> inputs = references("u");
  const std::vector<fmi3ValueReference> outputs = references("y");
  std::vector<fmi3Instance> instances;
  for (std::size_t i = 0; i < units; ++i) {
    instances.push_back(fmi.InstantiateCoSimulation(
        "u", wide()->description()->instantiation_token.c_str(), nullptr, false, false, false,
        false, nullptr, 0, nullptr, nullptr, nullptr));
    fmi.EnterInitializationMode(instances.back(), false, 0, 0, false, 0);
    fmi.ExitInitializationMode(instances.back());
  }
  std::vector<std::vector<double>> y(units, std::vector<double>(kWidth));
  std::vector<double> u(kWidth);
  const auto exchange = [&] {
    for (std::size_t i = 0; i < units; ++i) {
      fmi.GetFloat64(instances[i], outputs.data(), kWidth, y[i].data(), kWidth);
    }
    for (std::size_t i = 0; i < units; ++i) {
      for (std::size_t k = 0; k < kWidth; ++k) u[k] = y[source(i, k, units)][k];
      fmi.SetFloat64(instances[i], inputs.data(), kWidth, u.data(), kWidth);
    }
  };
  exchange();
  const auto began = Wall::now();
  for (std::size_t step = 0; step < steps; ++step) {
    const double point = to_seconds(kStep * static_cast<std::int64_t>(step));
    for (const fmi3Instance instance : instances) {
      bool event = false;
      bool terminate = false;
      bool early = false;
      double reached = 0;
      fmi.DoStep(instance, point, to_seconds(kStep), true, &event, &terminate, &early, &reached);
    }
    exchange();
  }
  const double seconds = seconds_since(began);
  for (const fmi3Instance instance : instances) fmi.FreeInstance(instance);
  return seconds;
}

/// Both in turn within each iteration, so that a machine that changes its speed changes it for
/// both.
void wide(benchmark::State& state) {
  const auto units = static_cast<std::size_t>(state.range(0));
  const std::size_t steps = kConnections / kWidth / units;
  double stride_seconds = 0;
  double hand_seconds = 0;
  for (auto _ : state) {
    const double mine = run_stride(units, steps);
    hand_seconds += run_by_hand(units, steps);
    stride_seconds += mine;
    state.SetIterationTime(mine);
  }
  const double copies =
      static_cast<double>(state.iterations()) * static_cast<double>(steps * units * kWidth);
  state.counters["stride_ns"] = 1e9 * stride_seconds / copies;
  state.counters["by_hand_ns"] = 1e9 * hand_seconds / copies;
  state.counters["ratio"] = stride_seconds / hand_seconds;
}

BENCHMARK(wide)->Arg(10)->Arg(100)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
