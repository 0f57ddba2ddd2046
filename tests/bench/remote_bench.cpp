// What a step costs by where its unit runs: in this process, in a host, behind `stride serve` on
// two pipes and, where STRIDE_BENCH_AT names a machine (ssh://machine), there; and bare round trips
// of messages of that size through the same pipes and the same ssh, where `cat` answers. All in
// turn within each iteration. What counts are the ratios.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "master/loader/network/command_process.h"
#include "master/loader/network/remote_unit.h"
#include "master/loader/process/hosted_unit.h"
#include "tests/bench/stopwatch.h"
#include "tests/build.h"

namespace {

using namespace stride;
using namespace stride::bench;

/// Of a message with the values of a step.
constexpr std::size_t kMessage = 72;

std::shared_ptr<importer::Fmu> integrator() {
  static const auto fmu = importer::Fmu::load(tests::test_unit_folder() / "early.fmu");
  return fmu;
}

/// An integrator in Step Mode, with one input and one output.
class SteppedUnit {
 public:
  explicit SteppedUnit(std::unique_ptr<core::Unit> unit) : unit_(std::move(unit)) {
    unit_->enter_initialization(Time{}, std::nullopt);
    unit_->exit_initialization();
    unit_->update_discrete_states();
    unit_->enter_step_mode();
  }

  double steps(int count) {
    const auto began = Wall::now();
    for (int i = 0; i < count; ++i) {
      const Time to = now_ + std::chrono::milliseconds(1);
      const core::StepResult result = unit_->step({now_, to}, {{&in_, 1}, {&out_, 1}});
      if (!result.reached_without_request(to)) throw std::logic_error("a step did not go through");
      now_ = to;
    }
    return seconds_since(began);
  }

 private:
  static core::ValueReference reference(const std::string& name) {
    const core::UnitDescription& description = *integrator()->description();
    return description.variables[description.find(name).value()].reference;
  }

  core::ValueReference input_ = reference("u"), output_ = reference("y");
  core::ValueBlock input_value_{core::ValueType::Float64, 1};
  core::ValueBlock output_value_{core::ValueType::Float64, 1};
  core::BoundValues in_{{&input_, 1}, input_value_}, out_{{&output_, 1}, output_value_};
  std::unique_ptr<core::Unit> unit_;
  Time now_{};
};

std::unique_ptr<core::Unit> unit_at(const remote::Place& place) {
  auto unit = std::make_unique<remote::RemoteUnit>(
      remote::RemoteSpec{.place = place, .fmu = integrator()->path().string()}, integrator(),
      "unit", importer::InstanceOptions{}, isolation::HostOptions{});
  unit->instantiate();
  return unit;
}

/// A program that sends back what it gets.
class Echo {
 public:
  explicit Echo(const std::vector<std::string>& command) : process_(command) { round_trips(1); }

  double round_trips(int count) {
    const auto began = Wall::now();
    std::string bytes(kMessage, 'x');
    for (int i = 0; i < count; ++i) {
      if (::write(process_.in.number(), bytes.data(), kMessage) < 0)
        throw std::logic_error("write");
      for (std::size_t got = 0; got < kMessage;) {
        pollfd file{process_.out.number(), POLLIN, 0};
        ::poll(&file, 1, -1);
        const ssize_t size = ::read(process_.out.number(), bytes.data(), kMessage - got);
        if (size <= 0) throw std::logic_error("the echo has ended");
        got += static_cast<std::size_t>(size);
      }
    }
    return seconds_since(began);
  }

 private:
  remote::CommandProcess process_;
};

struct Way {
  std::string name;
  std::function<double(int)> run;
  int share;  ///< of the steps: one in so many
  double seconds = 0;
};

void add_machine(std::vector<Way>& ways) {
  const char* const at = std::getenv("STRIDE_BENCH_AT");
  if (at == nullptr) return;
  remote::Place place = remote::parse_place(at, tests::stride_program().string());
  auto unit = std::make_shared<SteppedUnit>(unit_at(place));
  place.command.back() = "cat";
  auto echo = std::make_shared<Echo>(place.command);
  ways.push_back({"machine", [unit](int count) { return unit->steps(count); }, 10});
  ways.push_back({"machine_echo", [echo](int count) { return echo->round_trips(count); }, 10});
}

void remote_steps(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  std::vector<Way> ways;
  add_machine(ways);  // before this process has loaded the unit's library
  SteppedUnit served(
      unit_at(remote::parse_place("exec:exec " + tests::stride_program().string() + " serve")));
  SteppedUnit hosted(isolation::instantiate(integrator(), "unit", {}, {}));
  SteppedUnit near(integrator()->instantiate("unit"));
  Echo echo({"cat"});
  ways.push_back({"in_process", [&](int count) { return near.steps(count); }, 1});
  ways.push_back({"hosted", [&](int count) { return hosted.steps(count); }, 1});
  ways.push_back({"exec", [&](int count) { return served.steps(count); }, 10});
  ways.push_back({"pipe_echo", [&](int count) { return echo.round_trips(count); }, 10});
  for (auto _ : state) {
    for (Way& way : ways) way.seconds += way.run(std::max(1, steps / way.share));
    state.SetIterationTime(ways.back().seconds);
  }
  for (const Way& way : ways) {
    const double all = static_cast<double>(state.iterations()) * std::max(1, steps / way.share);
    state.counters[way.name + "_ns"] = 1e9 * way.seconds / all;
  }
}

BENCHMARK(remote_steps)
    ->Arg(100)
    ->Arg(5000)
    ->Iterations(20)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
