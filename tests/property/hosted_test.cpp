// Where a unit runs changes no result: in the process of the master or in one of its own, with its
// own state or with snapshots of that process in its place.
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kHostedSystems = kSanitized ? 4 : 20;
constexpr Duration kHostedStep = 1ms;
const Time kHostedStop{kSanitized ? 20ms : 50ms};

/// All that is counted, without the wall-clock times.
std::array<std::uint64_t, 9> counts(const core::UnitStatistics& unit) {
  return {unit.calls, unit.steps,  unit.early_returns, unit.rejections,       unit.rollbacks,
          unit.saves, unit.events, unit.messages_sent, unit.messages_received};
}

void check_same(const Results& results, const Results& expected) {
  check_same_bytes(results, expected);
  CHECK(results.statistics.communication_steps == expected.statistics.communication_steps);
  CHECK(results.statistics.undone_steps == expected.statistics.undone_steps);
  for (const auto& [name, unit] : expected.units) {
    INFO(name);
    CHECK(counts(results.units.at(name)) == counts(unit));
  }
}

/// Some of its components, not none.
std::set<std::string> some_of(const Assembly& system, unsigned seed) {
  std::mt19937 random(seed);
  const auto& components = system.declaration().components;
  std::set<std::string> chosen = {components[random() % components.size()].name};
  for (const auto& component : components) {
    if (random() % 2 == 0) chosen.insert(component.name);
  }
  return chosen;
}

/// Units that there are with a state and without.
bool is_varied(const core::ComponentDeclaration& component, const std::string& unit) {
  const std::string& name = component.description->model_identifier;
  return name == unit || name == unit + "_without_state";
}

/// The same system, of which these components have no state, as far as there is such a unit, and
/// the others have one.
template <class IsStateless>
Assembly with_states(const Assembly& system, IsStateless&& is_stateless) {
  Assembly other;
  for (const auto& component : system.declaration().components) {
    std::string unit = component.description->model_identifier;
    for (const std::string varied : {"early", "rejecter"}) {
      if (!is_varied(component, varied)) continue;
      unit = is_stateless(component.name) ? varied + "_without_state" : varied;
    }
    other.add(component.name, unit);
  }
  for (const auto& wire : system.declaration().connections) {
    other.wire(wire.from_component + "." + wire.from_connector,
               wire.to_component + "." + wire.to_connector);
  }
  for (const auto& start : system.declaration().start_values) {
    other.set(start.component + "." + start.variable, start.value);
  }
  return other;
}

Assembly without_states(const Assembly& system) {
  return with_states(system, [](const std::string&) { return true; });
}

/// Of the units without a state, the one that needs no snapshots: see core::step_order().
std::string final_unit(const Assembly& system) {
  for (const std::string unit : {"early", "rejecter"}) {
    for (const auto& component : system.declaration().components) {
      if (is_varied(component, unit)) return component.name;
    }
  }
  return "";
}

std::set<std::string> without_state_in(const Assembly& system) {
  std::set<std::string> names;
  for (const auto& component : system.declaration().components) {
    if (!component.description->can_save_state) names.insert(component.name);
  }
  return names;
}

core::RunOptions extrapolated(const core::StepPolicyType* policy) {
  core::RunOptions options = fixed_steps(kHostedStep, kHostedStop);
  options.extrapolation = core::Extrapolation::Linear;
  options.step.policy = policy;
  options.step.relative_tolerance = options.step.absolute_tolerance = 1e-2;
  return options;
}

}  // namespace

TEST_CASE("hosts for all units, or for some, change no result") {
  for (unsigned seed = 0; seed < kHostedSystems; ++seed) {
    Assembly system = random_system(seed, Wiring::Continuous);
    if (seed % 2 == 1) system = system.with_strict_own_steps(seed);
    const Results expected = run(system, kHostedStep, kHostedStop);
    for (const Assembly& hosted : {system.hosted(), system.hosted(some_of(system, seed))}) {
      INFO("seed " << seed << "\n" << hosted.text());
      check_same(run(hosted, kHostedStep, kHostedStop), expected);
    }
  }
}

TEST_CASE("hosts change no result on several threads") {
  for (unsigned seed = 0; seed < kHostedSystems / 4; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    INFO("seed " << seed << "\n" << system.text());
    const Results expected = run(system, kHostedStep, kHostedStop);
    check_same(run(system.hosted(), kHostedStep, kHostedStop, {3, {}, true}), expected);
  }
}

TEST_CASE("hosts change no result where inputs change within steps, or an error controls these") {
  const auto policy = GENERATE(&core::kFixedSteps, &core::kErrorControlledSteps);
  for (unsigned seed = 0, compared = 0; compared < kHostedSystems / 4; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const bool can_go_back = without_state_in(system).empty();
    if (policy == &core::kErrorControlledSteps && !can_go_back) continue;
    ++compared;
    INFO("seed " << seed << "\n" << system.text());
    check_same(run(system.hosted(), extrapolated(policy)), run(system, extrapolated(policy)));
  }
}

TEST_CASE("snapshots are as good as states") {
  const unsigned kCompared = kSanitized ? 4 : kHostedSystems / 4;
  std::uint64_t snapshots = 0, restores = 0;
  for (unsigned seed = 0, compared = 0; compared < kCompared; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const Assembly varied = without_states(system);
    const std::set<std::string> names = without_state_in(varied);
    if (names.size() < 2) continue;
    ++compared;
    INFO("seed " << seed << "\n" << varied.text());
    const Results results = run(varied.hosted(names, true), kHostedStep, kHostedStop);
    const auto is_final = [final = final_unit(system)](const std::string& name) {
      return name == final;
    };
    check_same_bytes(results, run(with_states(system, is_final), kHostedStep, kHostedStop));
    for (const std::string& name : names) {
      const auto& host = results.units.at(name).host;
      REQUIRE(host);
      CHECK(host->snapshots == results.units.at(name).saves);
      snapshots += host->snapshots;
      restores += host->restores;
    }
  }
  CHECK(snapshots > (kSanitized ? 10 : 80) * kCompared);
  CHECK(restores > (kSanitized ? 1 : 20) * kCompared);
}

TEST_CASE("an error controls the steps of units that have no state") {
  const core::RunOptions options = extrapolated(&core::kErrorControlledSteps);
  std::uint64_t undone = 0;
  for (unsigned seed = 0, compared = 0; compared < kHostedSystems / 10 + 1; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    if (!without_state_in(system).empty()) continue;
    const Assembly varied = without_states(system);
    const std::set<std::string> names = without_state_in(varied);
    if (names.empty()) continue;
    ++compared;
    INFO("seed " << seed << "\n" << varied.text());
    const Results results = run(varied.hosted(names, true), options);
    check_same_bytes(results, run(system, options));
    undone += results.statistics.undone_steps;
  }
  CHECK(undone > 0);
}

TEST_CASE("hosts change no result where idle units are suspended") {
  Assembly system;
  system.add("pump", "ticker", {{"period", "0.006"}});
  system.add("clock", "ticker", {{"period", "0.0031"}, {"announces", "1"}});
  system.add("tank", "idler",
             {{"rate", "5"}, {"period", "0.0215"}, {"announces", "1"}, {"inflow", "0"}});
  system.wire("pump.level", "tank.inflow").wire("clock.tick.clock", "tank.ask");
  core::RunOptions options = fixed_steps(kHostedStep, Time(100ms));
  options.idle.max_skip.assign(3, Duration(7ms));
  options.idle.least = kHostedStep;
  const Results expected = run(system, options);
  CHECK(expected.units.at("tank").suspensions > 3);
  const Results results = run(system.hosted(), options);
  check_same(results, expected);
  CHECK(results.units.at("tank").suspensions == expected.units.at("tank").suspensions);
}

TEST_CASE("hosts change no result of sampled values and of units of FMI 2.0") {
  Assembly system;
  system.add("wheel", "ticker", {{"period", "0.004"}, {"announces", "1"}});
  system.add("plant", "linear", {{"damping", "20"}, {"frequency", "30"}});
  system.add("controller", "sampled_controller", {{"period", "0.0033"}, {"shift", "0.0011"}});
  system.add("periodic", "periodic_controller");
  system.add("turner", "fmi2_turner", {{"turn", "0.0305"}});  // where it discards a step
  system.add("relaxation", "fmi2_relaxation", {{"k", "40"}});
  system.add("sum", "fmi2_integrator");
  system.wire("controller.u", "plant.u").wire("plant.x", "controller.y");
  system.wire("wheel.level", "controller.r").wire("turner.y", "periodic.r");
  system.wire("plant.y", "periodic.y").wire("plant.x", "relaxation.u").wire("plant.y", "sum.u");
  const bool is_extrapolated = GENERATE(false, true);
  core::RunOptions options = fixed_steps(kHostedStep, kHostedStop);
  if (is_extrapolated) options = extrapolated(&core::kFixedSteps);
  const Results expected = run(system, options);
  CHECK(expected.units.at("turner").rejections + (kSanitized ? 1 : 0) > 0);
  check_same(run(system.hosted(), options), expected);
}
