#include "master/engine/run/time_sampling.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

constexpr std::uint64_t kSteps = 1'000'000;

struct Sampled {
  RunStatistics statistics;
  std::chrono::nanoseconds spent{};  ///< by the unit in all steps
};

/// Steps that take no time, in which the unit is said to take duration(step).
template <class Duration>
Sampled sampled(bool measures, Duration&& duration) {
  Sampled run;
  run.statistics.units.resize(1);
  run.statistics.units[0].event_time = 5us;  // of the initialization
  WallClock clock(measures);
  TimeSampling sampling(clock, run.statistics);
  sampling.begin();
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    sampling.begin_step();
    const std::chrono::nanoseconds took = duration(step);
    if (clock.measures()) run.statistics.units[0].step_time += took;
    run.spent += took;
    sampling.end_step();
  }
  sampling.end();
  return run;
}

}  // namespace

TEST_CASE("times of fast steps are measured in a sample, and scaled to all") {
  const auto period = GENERATE(1U, 7U, 16U, 256U);
  const Sampled run =
      sampled(true, [&](std::uint64_t step) { return step % period == 0 ? 1000ns : 10ns; });
  const UnitStatistics& unit = run.statistics.units[0];
  INFO("every " << period << ", measured: " << run.statistics.measured_steps);
  CHECK(run.statistics.measured_steps > 10);
  CHECK(run.statistics.measured_steps < kSteps / 10);
  const auto last_block = 8192 * 1000ns;  // which may be cut off
  const auto error = std::chrono::abs(unit.step_time - run.spent);
  CHECK(error <= 6 * unit.step_time_uncertainty + last_block);
  CHECK(unit.event_time == 5us);
  CHECK(unit.event_time_uncertainty == 0ns);
}

TEST_CASE("without a clock that measures there are no times") {
  const Sampled run = sampled(false, [](std::uint64_t) { return 10ns; });
  CHECK(run.statistics.measured_steps == 0);
  CHECK(run.statistics.units[0].step_time == 0ns);
}
