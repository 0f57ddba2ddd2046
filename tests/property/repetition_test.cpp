// Where states are saved before some steps only, and a unit that is taken back repeats those in
// between, each result is what it is with a state saved before each step.
#include <catch2/catch.hpp>

#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kRepetitionSystems = kSanitized ? 6 : 60;
constexpr Time kRepetitionStop{100ms};

/// A random system with two units that reject steps, one of which feeds it.
Assembly restless(unsigned seed) {
  return with_rejecters(seed, Wiring::Continuous, "0.0001", "0.002").wire("r1.y", "source.u");
}

Results run_with(const Assembly& system, std::size_t most_steps,
                 core::Coupling coupling = core::Coupling::Jacobi,
                 core::Extrapolation extrapolation = core::Extrapolation::Hold) {
  core::RunOptions options = fixed_steps(1ms, kRepetitionStop);
  options.state_saving.most_steps = most_steps;
  options.state_saving.always = true;
  options.coupling = coupling;
  options.extrapolation = extrapolation;
  return run(system, options);
}

struct Counts {
  std::uint64_t saves = 0, rollbacks = 0, repeated = 0;
  explicit Counts(const Results& results) {
    for (const auto& [name, unit] : results.units) {
      saves += unit.saves;
      rollbacks += unit.rollbacks;
      repeated += unit.repeated_steps;
      CHECK_FALSE(unit.inexact_repetition);
    }
  }
};

}  // namespace

TEST_CASE("repeated steps change no bit of a random system with rejections") {
  const auto coupling = GENERATE(core::Coupling::Jacobi, core::Coupling::GaussSeidel);
  const auto extrapolation = GENERATE(core::Extrapolation::Hold, core::Extrapolation::Quadratic);
  std::uint64_t rollbacks = 0, repeated = 0, saves = 0, saves_of_each = 0;
  unsigned impossible = 0;
  for (unsigned seed = 0; seed < kRepetitionSystems; ++seed) {
    const Assembly system = restless(seed);
    INFO("seed " << seed << "\n" << system.text());
    Results each;
    try {
      each = run_with(system, 1, coupling, extrapolation);
    } catch (const core::Error&) {  // a unit without a state was too far when another one stopped
      ++impossible;
      continue;
    }
    for (const std::size_t most_steps : {2, 5, 100}) {
      const Results some = run_with(system, most_steps, coupling, extrapolation);
      const bool same_signals = some.signals == each.signals;
      CHECK(same_signals);
      CHECK(some.events == each.events);
      const Counts counts(some);
      rollbacks += counts.rollbacks;
      repeated += counts.repeated;
      saves += counts.saves;
    }
    const Counts counts(each);
    CHECK(counts.repeated == 0);
    saves_of_each += 3 * counts.saves;
  }
  CHECK(impossible * 10 < kRepetitionSystems);
  CHECK(rollbacks > 100 * kRepetitionSystems);
  CHECK(repeated > 10 * kRepetitionSystems);
  CHECK(saves < saves_of_each);
}

TEST_CASE("repeated steps change no bit where snapshots of processes take the place of states") {
  const Assembly system = Assembly()
                              .add("ball", "bouncing_ball", {{"start_height", "0.001"}})
                              .add("source", "linear")
                              .add("a", "rejecter_without_state", {{"seed", "1"}})
                              .add("b", "rejecter_without_state", {{"seed", "2"}})
                              .wire("source.x", "a.u")
                              .wire("source.x", "b.u")
                              .wire("a.y", "source.u")
                              .hosted({"a", "b"}, true);
  const Results each = run_with(system, 1);
  const Results some = run_with(system, 6);
  const bool same_signals = some.signals == each.signals;
  CHECK(same_signals);
  CHECK(some.events == each.events);
  CHECK(Counts(some).rollbacks > 5);
  CHECK(Counts(some).saves < Counts(each).saves);
}
