// What holds for every system, tried on many that are drawn at random.
#include "tests/property/random_system.h"

#include <algorithm>
#include <string_view>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kRandomSystems = kSanitized ? 10 : 100;
constexpr Duration kRandomStep = 1ms;
constexpr Time kRandomStop{100ms};

/// Whether `text` begins with `head`, said so that a failure shows the place.
void check_begins_with(const std::string& text, const std::string& head) {
  const auto [in_text, in_head] = std::mismatch(text.begin(), text.end(), head.begin(), head.end());
  INFO("they differ behind: " << std::string_view(head).substr(
           0, static_cast<std::size_t>(in_head - head.begin())));
  CHECK(in_head == head.end());
}

bool can_be_rolled_back(const Assembly& system) {
  const auto& components = system.declaration().components;
  return std::all_of(components.begin(), components.end(),
                     [](const auto& c) { return c.description->can_save_state; });
}

}  // namespace

TEST_CASE("the random systems have all that they should have") {
  core::UnitStatistics sum;
  std::uint64_t events = 0;
  for (unsigned seed = 0; seed < kRandomSystems; ++seed) {
    const Results results = run(random_system(seed, Wiring::Continuous), kRandomStep, kRandomStop);
    for (const auto& [name, unit] : results.units) {
      sum.rejections += unit.rejections;
      sum.early_returns += unit.early_returns;
      sum.rollbacks += unit.rollbacks;
      sum.messages_received += unit.messages_received;
    }
    events += results.statistics.event_iterations;
  }
  CHECK(sum.rejections > 10 * kRandomSystems);
  CHECK(sum.early_returns > 10 * kRandomSystems);
  CHECK(sum.rollbacks > 10 * kRandomSystems);
  CHECK(sum.messages_received > 10 * kRandomSystems);
  CHECK(events > 10 * kRandomSystems);
}

TEST_CASE("a run that is repeated writes the same bytes") {
  for (unsigned seed = 0; seed < kRandomSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    INFO("seed " << seed << "\n" << system.text());
    const Results first = run(system, kRandomStep, kRandomStop);
    const Results second = run(system, kRandomStep, kRandomStop);
    CHECK(first.signals == second.signals);
    CHECK(first.events == second.events);
  }
}

TEST_CASE("the order of the components and connections changes no result") {
  for (unsigned seed = 0; seed < kRandomSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const Results expected = run(system, kRandomStep, kRandomStop);
    for (unsigned order = 1; order <= 3; ++order) {
      const Assembly shuffled = system.shuffled(order);
      INFO("seed " << seed << ", order " << order << "\n" << shuffled.text());
      const Results results = run(shuffled, kRandomStep, kRandomStop);
      CHECK(results.values.size() == expected.values.size());
      const bool same_signals = results.signals == expected.signals;
      CHECK(same_signals);
      CHECK(results.event_rows() == expected.event_rows());
    }
  }
}

TEST_CASE("neither their order nor threads change what is extrapolated or error-controlled") {
  const auto extrapolation = GENERATE(core::Extrapolation::Linear, core::Extrapolation::Quadratic);
  const auto policy = GENERATE(&core::kFixedSteps, &core::kErrorControlledSteps);
  core::RunOptions options = fixed_steps(kRandomStep, kRandomStop);
  options.extrapolation = extrapolation;
  options.step.policy = policy;
  options.step.relative_tolerance = options.step.absolute_tolerance = 1e-2;
  core::RunOptions parallel = options;
  parallel.threads = {3, {}, true};
  unsigned compared = 0;
  for (unsigned seed = 0; compared < kRandomSystems / 10; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    if (policy == &core::kErrorControlledSteps && !can_be_rolled_back(system)) continue;
    ++compared;
    INFO("seed " << seed << "\n" << system.text());
    const Results expected = run(system, options);
    const Results shuffled = run(system.shuffled(1), options);
    const bool same_signals = shuffled.signals == expected.signals;
    CHECK(same_signals);
    CHECK(shuffled.event_rows() == expected.event_rows());
    const bool same_bytes = run(system, parallel).signals == expected.signals;
    CHECK(same_bytes);
  }
}

TEST_CASE("a run to the half of the time is the beginning of the whole run") {
  for (unsigned seed = 0; seed < kRandomSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    INFO("seed " << seed << "\n" << system.text());
    const Results half = run(system, kRandomStep, Time(50ms));
    const Results whole = run(system, kRandomStep, kRandomStop);
    CHECK(half.values.size() > 50);
    CHECK(half.values.size() < whole.values.size());
    check_begins_with(whole.signals, half.signals);
    check_begins_with(whole.events, half.events);
  }
}
