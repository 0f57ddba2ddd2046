// What idle skipping saves on a sensor that sleeps while its 50 MHz clock goes on: wall-clock time,
// the time that SystemC simulates, and the size of a trace of all signals.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <stride/systemc/idle.h>
#include <stride/systemc/trace.h>

#include "tests/units/sensor/bench.h"

using stride::Duration;
using stride::Time;
using stride::systemc::SignalList;
using stride::systemc::Trace;

namespace {

class SensorRules : public stride::systemc::IdleRules {
 public:
  explicit SensorRules(const sensor::Sensor& sensor) : sensor_(sensor) {}
  bool idle() const override { return sensor_.idle(); }
  Duration clock_period() const override { return sensor_.gated_clock.period(); }
  Duration longest_skip() const override { return Duration::max(); }
  void on_skip(Duration) override {}

 private:
  const sensor::Sensor& sensor_;
};

/// A sensor that has booted and sleeps.
struct Sleeper {
  Sleeper() {
    bench.run(sensor::ms(5));
    if (!rules.idle()) throw std::logic_error("the sensor does not sleep");
  }
  static sensor::SensorParameters parameters() {
    sensor::SensorParameters parameters = sensor::charged();
    parameters.control_unit.clock_gating = false;
    return parameters;
  }
  void run(Time to, bool skips) {
    if (skips) {
      skipper.advance(to, false, Duration::max());
    } else {
      bench.run(to);
    }
  }
  Duration simulated() const { return bench.device.now().time_since_epoch() - skipped(); }
  Duration skipped() const { return skipper.statistics().skipped; }

  sensor::Bench bench{parameters()};
  SensorRules rules{bench.device.module()};
  stride::systemc::IdleSkipper skipper{bench.device.kernel(), rules};
};

/// In steps of `step_ms`, as a master without promises makes them; or in one, with them.
void sleep(benchmark::State& state) {
  const Duration idle = sensor::ms(static_cast<double>(state.range(0))).time_since_epoch();
  const bool skips = state.range(1) != 0;
  const Duration step = sensor::ms(static_cast<double>(state.range(2))).time_since_epoch();
  Duration simulated{};
  for (auto _ : state) {
    state.PauseTiming();
    auto sleeper = std::make_unique<Sleeper>();
    simulated = sleeper->simulated();
    const Time end = sleeper->bench.device.now() + idle;
    state.ResumeTiming();
    while (sleeper->bench.device.now() < end) {
      sleeper->run(std::min(end, sleeper->bench.device.now() + step), skips);
    }
    state.PauseTiming();
    simulated = sleeper->simulated() - simulated;
    sleeper.reset();
    state.ResumeTiming();
  }
  state.counters["simulated_us"] = stride::to_seconds(simulated) * 1e6;
  state.counters["true_to_simulated"] = stride::to_seconds(idle) / stride::to_seconds(simulated);
}

/// The same in one step, with a trace.
void sleep_traced(benchmark::State& state) {
  const Duration idle = sensor::ms(static_cast<double>(state.range(0))).time_since_epoch();
  const std::string file = (std::filesystem::temp_directory_path() /
                            ("stride_idle_bench_" + std::to_string(getpid()) + ".vcd"))
                               .string();
  std::uintmax_t before = 0;
  std::uintmax_t bytes = 0;
  for (auto _ : state) {
    Sleeper sleeper;
    SignalList signals;
    sleeper.bench.read([&](sensor::Sensor& sensor) {
      visit_signals(sensor, [&](const auto& signal) { signals.add(signal); });
    });
    { const Trace trace(sleeper.bench.device.kernel(), {file, "*"}, signals); }
    before = std::filesystem::file_size(file);
    {
      const Trace trace(sleeper.bench.device.kernel(), {file, "*"}, signals);
      sleeper.run(sleeper.bench.device.now() + idle, state.range(1) != 0);
    }
    bytes = std::filesystem::file_size(file);
  }
  std::filesystem::remove(file);
  state.counters["trace_bytes"] = static_cast<double>(bytes - before);
  state.counters["header_bytes"] = static_cast<double>(before);
}

}  // namespace

BENCHMARK(sleep)
    ->ArgNames({"ms", "skips", "step_ms"})
    ->Args({10, 1, 1})
    ->Args({7100, 0, 7100})
    ->Args({7100, 1, 7100})
    ->Args({7100, 1, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(sleep_traced)
    ->ArgNames({"ms", "skips"})
    ->Args({10, 1})
    ->Args({71, 0})
    ->Args({71, 1})
    ->Args({7100, 1})
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
