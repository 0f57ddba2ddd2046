// Random systems of real units on threads: the same bytes and the same counts as on one.
#include <array>

#include <catch2/catch.hpp>

#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kSystems = kSanitized ? 10 : 50;
constexpr Duration kStep = 1ms;
constexpr Time kStop{50ms};

/// All that is counted, without the wall-clock times.
std::array<std::uint64_t, 8> counts(const core::UnitStatistics& unit) {
  return {unit.steps, unit.early_returns, unit.rejections,    unit.rollbacks,
          unit.saves, unit.events,        unit.messages_sent, unit.messages_received};
}

void check_same(const Results& results, const Results& expected) {
  check_same_bytes(results, expected);
  CHECK(results.statistics.communication_steps == expected.statistics.communication_steps);
  CHECK(results.statistics.event_iterations == expected.statistics.event_iterations);
  for (const auto& [name, unit] : expected.units) {
    INFO(name);
    CHECK(counts(results.units.at(name)) == counts(unit));
  }
}

}  // namespace

TEST_CASE("two and four threads give what one gives") {
  std::uint64_t parallel_steps = 0;
  for (unsigned seed = 0; seed < kSystems; ++seed) {
    Assembly system = random_system(seed, Wiring::Continuous);
    if (seed % 2 == 1) system = system.with_strict_own_steps(seed);
    const Results expected = run(system, kStep, kStop);
    for (const std::size_t threads : {2, 4}) {
      INFO("seed " << seed << ", " << threads << " threads\n" << system.text());
      const Results results = run(system, kStep, kStop, {threads, {}, true});
      check_same(results, expected);
      parallel_steps += results.statistics.parallel_steps;
    }
  }
  CHECK(parallel_steps > 50 * kSystems);
}
