// Serial against parallel: communication steps of units that burn a given time each, on one thread,
// on two where the run finds that they pay, and on two in any case. What counts are the ratios,
// serial : parallel. Where threads cannot pay the first one is 1, for then they are not used; the
// second one shows what they would have cost. The times are the best of all iterations, since other
// programs only ever make them longer.
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "master/engine/run/simulation.h"

namespace {

using namespace stride;
using Wall = std::chrono::steady_clock;

double burn(double value, std::int64_t rounds) {
  for (std::int64_t i = 0; i < rounds; ++i) value = value * 0.999 + 0.001;
  return value;
}

/// Rounds of burn() in a nanosecond, on a core that has nothing else to do: the best of many.
double rounds_per_nanosecond() {
  constexpr std::int64_t kRounds = 20'000;
  auto best = Wall::duration::max();
  for (int i = 0; i < 200; ++i) {
    const auto began = Wall::now();
    benchmark::DoNotOptimize(burn(static_cast<double>(i), kRounds));
    best = std::min(best, Wall::now() - began);
  }
  return kRounds / std::chrono::duration<double, std::nano>(best).count();
}

/// A unit without variables whose steps take a given time.
class BusyUnit : public core::Unit {
 public:
  explicit BusyUnit(std::int64_t rounds) : rounds_(rounds) {}

  void enter_initialization(Time, std::optional<Time>) override {}
  void exit_initialization() override {}
  void get(std::span<const core::ValueReference>, core::ValueBlock&) override {}
  void set(std::span<const core::ValueReference>, const core::ValueBlock&) override {}
  core::StepResult step(const core::StepInterval& interval) override {
    value_ = burn(value_, rounds_);
    benchmark::DoNotOptimize(value_);
    return {.reached = interval.to};
  }
  void enter_event_mode() override {}
  core::EventResult update_discrete_states() override { return {}; }
  void enter_step_mode() override {}
  void terminate() override {}

 private:
  std::int64_t rounds_;
  double value_ = 0;
};

struct Outcome {
  double microseconds;    ///< a communication step
  double parallel_share;  ///< of the communication steps
};

Outcome run(std::size_t units, std::int64_t rounds, core::ThreadOptions threads, int steps) {
  const auto description = std::make_shared<core::UnitDescription>();
  description->can_vary_step = true;
  description->may_reject = false;
  core::SystemDeclaration declaration;
  std::vector<std::unique_ptr<core::Unit>> instances;
  for (std::size_t i = 0; i < units; ++i) {
    declaration.components.push_back({"u" + std::to_string(i), description, {}, {}});
    instances.push_back(std::make_unique<BusyUnit>(rounds));
  }
  const core::System system(declaration);
  core::RunOptions options;
  options.step.size = std::chrono::milliseconds(1);
  options.stop = Time(std::chrono::milliseconds(1) * steps);
  options.threads = std::move(threads);
  options.measure_time = false;
  core::Simulation simulation(system, std::move(instances), options);
  simulation.run();
  const core::RunStatistics& statistics = simulation.statistics();
  return {std::chrono::duration<double, std::micro>(statistics.wall_time).count() / steps,
          static_cast<double>(statistics.parallel_steps) / steps};
}

/// Arguments: units, nanoseconds of a unit's step. The three ways in turn within each iteration, so
/// that a machine that changes its speed changes it for all.
void parallel(benchmark::State& state) {
  static const double speed = rounds_per_nanosecond();
  const auto units = static_cast<std::size_t>(state.range(0));
  const auto cost = static_cast<double>(state.range(1));
  const auto rounds = static_cast<std::int64_t>(cost * speed);
  const int steps = static_cast<int>(1e8 / (cost * static_cast<double>(units)));  // 0.1 s each
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double serial = kNever;
  Outcome adaptive{kNever, 0};
  double forced = kNever;
  for (auto _ : state) {
    serial = std::min(serial, run(units, rounds, {}, steps).microseconds);
    const Outcome mine = run(units, rounds, {2, {}, false}, steps);
    if (mine.microseconds < adaptive.microseconds) adaptive = mine;
    const int few = std::min(steps, 5'000);  // for where it is slow
    forced = std::min(forced, run(units, rounds, {2, {}, true}, few).microseconds);
  }
  state.counters["serial_us"] = serial;
  state.counters["parallel_us"] = adaptive.microseconds;
  state.counters["parallel_share"] = adaptive.parallel_share;
  state.counters["ratio"] = serial / adaptive.microseconds;
  state.counters["forced_ratio"] = serial / forced;
}

BENCHMARK(parallel)
    ->ArgNames({"units", "ns"})
    ->ArgsProduct({{2, 8}, {100, 5'000, 50'000, 500'000}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
