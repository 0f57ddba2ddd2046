// Random systems with random interventions: the same bytes on threads, in processes of their own,
// and with states that are saved before each step.
#include <catch2/catch.hpp>

#include "tests/property/random_interventions.h"
#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr Time kStop{50ms};

RunOptions options_with(const std::vector<Intervention>& interventions) {
  RunOptions options = fixed_steps(1ms, kStop);
  options.interventions = interventions;
  return options;
}

}  // namespace

TEST_CASE("interventions are the same on threads and with states saved before each step") {
  const unsigned systems = kSanitized ? 8 : 40;
  unsigned changed = 0;
  for (unsigned seed = 0; seed < systems; ++seed) {
    const Assembly system = with_rejecters(seed, Wiring::Continuous, "0.0003", "0.002");
    INFO("seed " << seed << "\n" << system.text());
    RunOptions options = options_with(random_interventions(system, seed));
    const Results expected = run(system, options);
    changed += expected.signals != run(system, options_with({})).signals;
    RunOptions threads = options;
    threads.threads = {2, {}, true};
    check_same_bytes(run(system, threads), expected);
    options.state_saving.most_steps = 1;
    check_same_bytes(run(system, options), expected);
  }
  CHECK(changed > systems / 2);
}

TEST_CASE("interventions are the same in processes of their own") {
  const unsigned systems = kSanitized ? 2 : 8;
  for (unsigned seed = 0; seed < systems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    INFO("seed " << seed << "\n" << system.text());
    const RunOptions options = options_with(random_interventions(system, seed));
    check_same_bytes(run(system.hosted(), options), run(system, options));
  }
}
