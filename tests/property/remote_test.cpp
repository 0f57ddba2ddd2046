// A unit behind `stride serve` gives the results of one in this process: the same bits.
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kServedSystems = kSanitized ? 2 : 8;
constexpr Duration kServedStep = 1ms;
const Time kServedStop{kSanitized ? 20ms : 50ms};

/// The same system, whose units have no state where there is such a unit.
Assembly stateless(const Assembly& system) {
  Assembly other;
  for (const auto& component : system.declaration().components) {
    const std::string& unit = component.description->model_identifier;
    const bool has_variant = unit == "early" || unit == "rejecter";
    other.add(component.name, has_variant ? unit + "_without_state" : unit);
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

std::set<std::string> units_without_state(const Assembly& system) {
  std::set<std::string> names;
  for (const auto& component : system.declaration().components) {
    if (!component.description->can_save_state) names.insert(component.name);
  }
  return names;
}

core::RunOptions extrapolated_steps(const core::StepPolicyType* policy) {
  core::RunOptions options = fixed_steps(kServedStep, kServedStop);
  options.extrapolation = core::Extrapolation::Linear;
  options.step.policy = policy;
  options.step.relative_tolerance = options.step.absolute_tolerance = 1e-2;
  return options;
}

}  // namespace

TEST_CASE("units behind stride serve change no result") {
  std::uint64_t rollbacks = 0, round_trips = 0;
  for (unsigned seed = 0; seed < kServedSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    INFO("seed " << seed << "\n" << system.text());
    const Results expected = run(system, kServedStep, kServedStop);
    const Results results = run(system.hosted().served(), kServedStep, kServedStop);
    check_same_bytes(results, expected);
    for (const auto& [name, unit] : expected.units) {
      INFO(name);
      CHECK(results.units.at(name).steps == unit.steps);
      CHECK(results.units.at(name).calls == unit.calls);
      REQUIRE(results.units.at(name).host);
      REQUIRE(results.units.at(name).host->link);
      round_trips += results.units.at(name).host->link->round_trips;
      CHECK(results.units.at(name).host->most_memory > 0);
      rollbacks += unit.rollbacks;
    }
  }
  CHECK(rollbacks > 0);
  CHECK(round_trips > 0);
}

TEST_CASE("inputs within steps and steps that are redone reach units behind stride serve") {
  const auto policy = GENERATE(&core::kFixedSteps, &core::kErrorControlledSteps);
  for (unsigned seed = 0, compared = 0; compared < kServedSystems / 4 + 1; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    if (policy == &core::kErrorControlledSteps && !units_without_state(system).empty()) continue;
    ++compared;
    INFO("seed " << seed << "\n" << system.text());
    check_same_bytes(run(system.hosted().served(), extrapolated_steps(policy)),
                     run(system, extrapolated_steps(policy)));
  }
}

TEST_CASE("snapshots behind stride serve are as good as those of hosts here") {
  std::uint64_t restores = 0;
  const auto are_enough = [&](unsigned compared) {
    return compared >= kServedSystems / 4 + 1 && restores > 0;
  };
  for (unsigned seed = 0, compared = 0; !are_enough(compared) && seed < 40; ++seed) {
    const Assembly system = stateless(random_system(seed, Wiring::Continuous));
    const std::set<std::string> names = units_without_state(system);
    if (names.size() < 2) continue;
    ++compared;
    INFO("seed " << seed << "\n" << system.text());
    const Assembly hosted = system.hosted(names, true);
    const Results results = run(hosted.served(), kServedStep, kServedStop);
    check_same_bytes(results, run(hosted, kServedStep, kServedStop));
    for (const std::string& name : names) restores += results.units.at(name).host->restores;
  }
  CHECK(restores > 0);
}

TEST_CASE("idle units behind stride serve are suspended likewise") {
  Assembly system;
  system.add("pump", "ticker", {{"period", "0.006"}});
  system.add("clock", "ticker", {{"period", "0.0031"}, {"announces", "1"}});
  system.add("tank", "idler",
             {{"rate", "5"}, {"period", "0.0215"}, {"announces", "1"}, {"inflow", "0"}});
  system.wire("pump.level", "tank.inflow").wire("clock.tick.clock", "tank.ask");
  core::RunOptions options = fixed_steps(kServedStep, Time(100ms));
  options.idle.max_skip.assign(3, Duration(7ms));
  options.idle.least = kServedStep;
  const Results expected = run(system, options);
  const Results results = run(system.hosted().served(), options);
  check_same_bytes(results, expected);
  CHECK(results.units.at("tank").suspensions == expected.units.at("tank").suspensions);
  CHECK(expected.units.at("tank").suspensions > 3);
}

TEST_CASE("clocks, samples and units of FMI 2.0 behind stride serve give the same results") {
  Assembly system;
  system.add("wheel", "ticker", {{"period", "0.004"}, {"announces", "1"}});
  system.add("plant", "linear", {{"damping", "20"}, {"frequency", "30"}});
  system.add("controller", "sampled_controller", {{"period", "0.0033"}, {"shift", "0.0011"}});
  system.add("periodic", "periodic_controller");
  system.add("turner", "fmi2_turner", {{"turn", "0.0305"}});
  system.add("sum", "fmi2_integrator");
  system.wire("controller.u", "plant.u").wire("plant.x", "controller.y");
  system.wire("wheel.level", "controller.r").wire("turner.y", "periodic.r");
  system.wire("plant.y", "periodic.y").wire("plant.y", "sum.u");
  const core::RunOptions options = fixed_steps(kServedStep, kServedStop);
  check_same_bytes(run(system.hosted().served(), options), run(system, options));
}
