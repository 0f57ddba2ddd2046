// What the way to a unit costs: nanoseconds per step of an integrator with one input and one
// output, in this process, in a process of its own, there with a snapshot before each step, and
// through the pipe of the unit `process`, to a program in C++ and to a class of Python; what
// several units in processes of their own cost; and what a snapshot costs beside a bare fork of a
// process of the same size. All in turn within each iteration, so that a machine that changes its
// speed changes it for all. What counts are the ratios and the differences.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/loader/fmu/fmu.h"
#include "master/loader/process/hosted_unit.h"
#include "tests/bench/stopwatch.h"
#include "tests/build.h"
#include "tests/master/engine/run/unit_capabilities.h"

namespace {

using namespace stride;
using namespace stride::bench;

constexpr Duration kStep = std::chrono::milliseconds(1);

/// A unit in Step Mode that is given its input `u` and asked for its output `y` in each step.
class Stepped {
 public:
  Stepped(const core::UnitDescription& description, std::unique_ptr<core::Unit> unit)
      : input_(reference(description, "u")),
        output_(reference(description, "y")),
        bound_input_({&input_, 1}, input_value_),
        bound_output_({&output_, 1}, output_value_),
        unit_(std::move(unit)) {
    unit_->enter_initialization(Time{}, std::nullopt);
    unit_->exit_initialization();
    if (!description.has_event_mode) return;
    unit_->update_discrete_states();
    unit_->enter_step_mode();
  }

  Stepped(const Stepped&) = delete;
  Stepped& operator=(const Stepped&) = delete;

  /// Returns the seconds that they took.
  double steps(int count, bool saves = false) {
    const auto began = Wall::now();
    for (int i = 0; i < count; ++i) {
      if (saves) tests::state(*unit_).save_state();
      input_value_.numbers<double>()[0] = 1 + i;
      const Time to = now_ + kStep;
      const core::StepResult result =
          unit_->step({now_, to}, {{&bound_input_, 1}, {&bound_output_, 1}});
      if (!result.reached_without_request(to)) throw std::logic_error("a step did not go through");
      now_ = to;
    }
    return seconds_since(began);
  }

 private:
  static core::ValueReference reference(const core::UnitDescription& description,
                                        const std::string& name) {
    return description.variables[description.find(name).value()].reference;
  }

  core::ValueReference input_, output_;
  core::ValueBlock input_value_{core::ValueType::Float64, 1};
  core::ValueBlock output_value_{core::ValueType::Float64, 1};
  core::BoundValues bound_input_, bound_output_;
  std::unique_ptr<core::Unit> unit_;
  Time now_{};
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A unit that has no state of its own.
std::shared_ptr<importer::Fmu> integrator() {
  static const auto fmu =
      importer::Fmu::load(tests::test_unit_folder() / "early_without_state.fmu");
  return fmu;
}

Stepped in_process(const std::shared_ptr<importer::Fmu>& fmu) {
  return {*fmu->description(), fmu->instantiate("unit")};
}

Stepped piped(const std::string& unit) {
  return in_process(importer::Fmu::load(tests::test_unit_folder() / (unit + ".fmu")));
}

Stepped hosted() {
  isolation::HostOptions options;
  options.takes_snapshots = true;
  return {*integrator()->description(), isolation::instantiate(integrator(), "unit", {}, options)};
}

void transport(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  const int snapshots = std::max(1, steps / 100);  // and steps through the pipe
  Stepped other = hosted();  // before this process has loaded the unit's library
  Stepped snapshotted = hosted();
  Stepped near = in_process(integrator());
  Stepped pipe = piped("integrator");
  Stepped python = piped("python_integrator");
  double near_seconds = 0, other_seconds = 0, snapshot_seconds = 0;
  std::vector<double> pipe_seconds, python_seconds;  // medians: a step waits for the scheduler
  for (auto _ : state) {
    near_seconds += near.steps(steps);
    const double mine = other.steps(steps);
    other_seconds += mine;
    snapshot_seconds += snapshotted.steps(snapshots, true);
    pipe_seconds.push_back(pipe.steps(snapshots) / snapshots);
    python_seconds.push_back(python.steps(snapshots) / snapshots);
    state.SetIterationTime(mine);
  }
  const double all = static_cast<double>(state.iterations()) * steps;
  const double few = static_cast<double>(state.iterations()) * snapshots;
  const double near_ns = 1e9 * near_seconds / all;
  const double hosted_ns = 1e9 * other_seconds / all;
  state.counters["in_process_ns"] = near_ns;
  state.counters["hosted_ns"] = hosted_ns;
  state.counters["hosted_more_ns"] = hosted_ns - near_ns;
  state.counters["hosted_ratio"] = hosted_ns / near_ns;
  state.counters["snapshot_ns"] = 1e9 * snapshot_seconds / few;
  const double pipe_ns = 1e9 * median(pipe_seconds);
  const double python_ns = 1e9 * median(python_seconds);
  state.counters["pipe_ns"] = pipe_ns;
  state.counters["pipe_ratio"] = pipe_ns / near_ns;
  state.counters["python_ns"] = python_ns;
  state.counters["python_ratio"] = python_ns / near_ns;
  state.counters["python_to_pipe"] = python_ns / pipe_ns;
}

/// Seconds of a run of a ring of workers, each in a process of its own.
double run_workers(std::int64_t count, const std::string& rounds, int steps) {
  static const auto fmu = importer::Fmu::load(tests::test_unit_folder() / "worker.fmu");
  core::SystemDeclaration declaration;
  std::vector<std::unique_ptr<core::Unit>> units;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string name = fmt::format("u{}", i);
    declaration.components.push_back({name, fmu->description(), {}, {}});
    declaration.connections.push_back(
        {name, "y", fmt::format("u{}", (i + 1) % count), "u", false, {}});
    declaration.start_values.push_back({name, "rounds", rounds, "", {}});
    units.push_back(isolation::instantiate(fmu, name, {}, {}));
  }
  const core::System system(declaration);
  core::RunOptions options;
  options.step.size = kStep;
  options.stop = Time(kStep * steps);
  options.measure_time = false;
  core::Simulation simulation(system, std::move(units), options);
  return time_steps(simulation);
}

/// Communication steps of several units in processes of their own, beside those of one: with as
/// many cores the ratio would be 1. With more of them than cores those that wait must not keep the
/// others from working.
void hosts(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  const std::string rounds = std::to_string(state.range(2));
  std::vector<double> one, several;
  for (auto _ : state) {
    one.push_back(run_workers(1, rounds, steps));
    several.push_back(run_workers(state.range(1), rounds, steps));
    state.SetIterationTime(several.back());
  }
  state.counters["one_us"] = 1e6 * median(one) / steps;
  state.counters["several_us"] = 1e6 * median(several) / steps;
  state.counters["ratio"] = median(several) / median(one);
}

/// Seconds from the fork to the end of a child that does nothing.
double bare_fork() {
  const auto began = Wall::now();
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  if (child < 0 || ::waitpid(child, nullptr, 0) != child) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  return seconds_since(began);
}

/// Of a process that has so many MiB more than this one needs: the unit's is made as its copy.
void snapshot(benchmark::State& state) {
  const std::vector<char> ballast(static_cast<std::size_t>(state.range(0)) << 20, 1);
  const int steps = static_cast<int>(state.range(1));
  benchmark::DoNotOptimize(ballast.data());
  Stepped plain = hosted();
  Stepped snapshotted = hosted();
  double plain_seconds = 0, snapshot_seconds = 0, fork_seconds = 0;
  for (auto _ : state) {
    plain_seconds += plain.steps(steps);
    const double mine = snapshotted.steps(steps, true);
    snapshot_seconds += mine;
    for (int i = 0; i < steps; ++i) fork_seconds += bare_fork();
    state.SetIterationTime(mine);
  }
  const double all = static_cast<double>(state.iterations()) * steps;
  const double more = snapshot_seconds - plain_seconds;
  state.counters["snapshot_us"] = 1e6 * more / all;
  state.counters["fork_us"] = 1e6 * fork_seconds / all;
  state.counters["ratio"] = more / fork_seconds;
}

BENCHMARK(transport)->Arg(100)->Arg(20'000)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(hosts)
    ->ArgNames({"", "hosts", "rounds"})
    ->Args({100, 2, 0})
    ->Args({2000, 1, 0})
    ->Args({2000, 2, 0})
    ->Args({2000, 4, 0})
    ->Args({500, 2, 20'000})
    ->Args({500, 4, 20'000})
    ->Iterations(15)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(snapshot)
    ->Args({0, 100})
    ->Args({20, 100})
    ->Args({100, 100})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
