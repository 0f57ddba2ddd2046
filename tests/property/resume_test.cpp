// A run that goes on from its state in another simulation is, bit for bit, the run that was never
// interrupted.
#include <algorithm>
#include <random>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/cut_run.h"
#include "tests/property/random_interventions.h"
#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr Time kCutStop{50ms};

/// Idle units, which are suspended; asked by messages, and fed by what changes at events.
Assembly idle_units(unsigned seed) {
  Assembly system;
  system.add("pump", "ticker", {{"period", "0.006"}});
  system.add("clock", "ticker", {{"period", "0.0031"}, {"announces", seed % 2 == 0 ? "1" : "0"}});
  system.add("tank", "idler", {{"rate", "5"}, {"period", "0.0215"}, {"inflow", "0"}});
  system.add("basin", "idler", {{"rate", "9"}, {"period", "0.0171"}, {"announces", "1"}});
  system.add("well", "idler", {{"rate", "2"}, {"inflow", "0.1"}});
  system.add("cistern", "idler", {{"rate", "3"}});
  system.wire("pump.level", "tank.inflow").wire("tank.level", "basin.inflow");
  system.wire("well.level", "cistern.inflow").wire("clock.tick.clock", "tank.ask");
  return system;
}

/// Nothing but idle units, so that all are suspended at times.
Assembly only_idle_units() {
  Assembly system;
  system.add("well", "idler", {{"rate", "2"}, {"inflow", "0.1"}, {"period", "0.0173"}});
  system.add("cistern", "idler", {{"rate", "3"}, {"period", "0.0111"}});
  return system.wire("well.level", "cistern.inflow");
}

/// Time-based clocks, and loops that are solved at events.
Assembly clocks_and_loops(unsigned seed) {
  Assembly system;
  system.add("wheel", "ticker", {{"period", "0.004"}, {"announces", "1"}});
  system.add("plant", "linear", {{"damping", "20"}, {"frequency", "30"}});
  system.add("controller", "sampled_controller", {{"period", "0.0033"}, {"shift", "0.0011"}});
  system.add("periodic", "periodic_controller");
  system.wire("controller.u", "plant.u").wire("plant.x", "controller.y");
  system.wire("wheel.level", "controller.r").wire("plant.y", "periodic.y");
  const std::string jump = seed % 2 == 0 ? "0.0137" : "0.028";
  system.add("f", "feedthrough", {{"cosine", "1"}, {"jump_at", jump}, {"jump_to", "0.3"}});
  system.add("g", "feedthrough", {{"slope", "-0.5"}, {"jump_at", "0.031"}, {"jump_to", "1"}});
  system.add("follows", "linear").wire("f.y", "follows.u");
  return system.wire("f.y", "g.u").wire("g.y", "f.u");
}

Assembly system_without_own_steps(unsigned seed) {
  switch (seed % 8) {
    case 0:
      return idle_units(seed / 8);
    case 1:
      return clocks_and_loops(seed / 8);
    case 2:
      return seed % 16 == 2 ? only_idle_units() : random_system(seed, Wiring::EventsOnly);
    case 3:
      return with_rejecters(seed, Wiring::Continuous, "0.0003", "0.002");
    default:
      return random_system(seed, Wiring::Continuous);
  }
}

Assembly system_of(unsigned seed) {
  const Assembly assembly = system_without_own_steps(seed);
  return seed % 3 == 0 ? assembly.with_strict_own_steps(seed) : assembly;
}

bool can_all_go_back(const Assembly& assembly) {
  return std::ranges::all_of(assembly.declaration().components,
                             [](const auto& c) { return c.description->can_save_state; });
}

std::vector<VariableId> all_outputs(const System& system) {
  std::vector<VariableId> ids;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (variables[k].causality == Causality::Output && system.is_signal({i, k})) {
        ids.push_back({i, k});
      }
    }
  }
  return ids;
}

/// Some of the variables that can be recorded: inputs and local ones, too.
std::vector<VariableId> some_variables(const System& system, std::mt19937& random) {
  const unsigned share = 1 + random() % 4;
  std::vector<VariableId> ids;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const bool is_wanted =
          variables[k].causality != Causality::Independent && random() % 5 < share;
      if (is_wanted && system.is_signal({i, k})) ids.push_back({i, k});
    }
  }
  return ids;
}

/// A unit of the kit computes what belongs to a clock where one such output is read at its tick.
void add_sampled(const System& system, std::vector<VariableId>& ids) {
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      if (variables[k].causality != Causality::Output || !system.is_sampled({i, k})) continue;
      ids.push_back({i, k});
      break;
    }
  }
}

RunOptions options_of(unsigned seed, const Assembly& assembly, const System& system) {
  std::mt19937 random(seed);
  RunOptions options = fixed_steps(1ms, kCutStop);
  options.recorded = all_outputs(system);
  options.interventions =
      random() % 3 != 0 ? random_interventions(assembly, seed) : std::vector<Intervention>{};
  options.state_saving.most_steps = random() % 2 == 0 ? 1 : 5;
  if (seed % 8 == 0 || seed % 16 == 2) {
    options.idle.max_skip.assign(system.components().size(), random() % 2 == 0 ? 7ms : 1s);
    options.idle.least = 1ms;
  } else {
    options.coupling = random() % 3 == 0 ? Coupling::GaussSeidel : Coupling::Jacobi;
    options.extrapolation = kExtrapolations[random() % 3];
    options.step.policy = kStepPolicies[random() % 3];
    if (options.step.policy->controls_error && !can_all_go_back(assembly)) {
      options.step.policy = &kFixedSteps;
    }
    options.step.maximum = options.step.policy->has_grid ? std::nullopt : std::optional(5ms);
    options.step.relative_tolerance = options.step.absolute_tolerance = 1e-2;
  }
  if (random() % 3 == 0) options.threads = {3, {}, true};
  return options;
}

/// What does not depend on when states are saved.
std::vector<std::uint64_t> counts(const RunStatistics& statistics, bool saves_each_step) {
  std::vector<std::uint64_t> counts{statistics.communication_steps, statistics.undone_steps,
                                    statistics.event_iterations, statistics.parallel_steps};
  for (const UnitStatistics& unit : statistics.units) {
    counts.insert(counts.end(),
                  {unit.steps, unit.early_returns, unit.rejections, unit.rollbacks, unit.events,
                   unit.unannounced_events, unit.suspensions, unit.messages_sent,
                   unit.messages_received, static_cast<std::uint64_t>(unit.suspended_time.count()),
                   static_cast<std::uint64_t>(unit.longest_suspension.count())});
    if (saves_each_step) counts.insert(counts.end(), {unit.calls, unit.saves});
  }
  return counts;
}

/// The texts may be long.
void check_same(const std::string& text, const std::string& expected) {
  if (text == expected) return;
  const auto [differs, other] =
      std::mismatch(text.begin(), text.end(), expected.begin(), expected.end());
  const auto at = static_cast<std::size_t>(differs - text.begin());
  const std::size_t line = text.rfind('\n', at) + 1;
  FAIL_CHECK("they differ:\n"
             << text.substr(line, 400) << "\nexpected:\n"
             << expected.substr(line, 400));
}

struct Whole {
  Trace trace;
  RunStatistics statistics;
};

Whole run_whole(const Assembly& assembly, const System& system, const RunOptions& options) {
  Whole whole{Trace(system), {}};
  whole.statistics = CutRun{system, share(assembly.instantiate()), whole.trace}.from({}, options);
  return whole;
}

/// At each point, of both kinds, and at times between them.
class ManyPauses : public RunControl {
 public:
  std::optional<Pause> next(Time now) override {
    ++pauses;
    return Pause{now + std::chrono::microseconds(random_() % 3000), random_() % 2 == 0};
  }
  void on_pause(Time) override {}
  std::size_t pauses = 0;

 private:
  std::mt19937 random_;
};

/// Adds interventions at the last moment.
class Adder : public RunControl {
 public:
  explicit Adder(std::vector<Intervention> interventions)
      : interventions_(std::move(interventions)),
        first_(std::ranges::min_element(interventions_, {}, &Intervention::from)->from) {}

  Simulation* simulation = nullptr;
  std::optional<Pause> next(Time) override {
    return interventions_.empty() ? std::nullopt : std::optional(Pause{first_, true});
  }
  void on_pause(Time) override { simulation->add_interventions(std::exchange(interventions_, {})); }

 private:
  std::vector<Intervention> interventions_;
  Time first_;
};

const unsigned kCutSystems = kSanitized ? 24 : 120;

}  // namespace

TEST_CASE("a run that was cut is the run that was not, bit for bit") {
  std::mt19937 random;
  for (unsigned seed = 0; seed < kCutSystems; ++seed) {
    const Assembly assembly = system_of(seed);
    const System system(assembly.declaration());
    const RunOptions options = options_of(seed, assembly, system);
    const Whole whole = run_whole(assembly, system, options);
    const std::vector<Time>& points = whole.trace.points();
    const bool saves_each_step = options.state_saving.most_steps == 1;
    for (int trial = 0; trial < 4; ++trial) {
      const std::size_t first = random() % points.size();
      const std::size_t second = first + random() % (points.size() - first);
      INFO("seed " << seed << ", " << options.step.policy->name << ", cut at "
                   << to_seconds(points[first]) << " s and " << to_seconds(points[second]) << " s\n"
                   << assembly.text());
      Trace trace(system);
      CutRun run{system, share(assembly.instantiate()), trace};
      std::vector<std::byte> state = trial == 2
                                         ? run.up_to_point(first, options)
                                         : run.up_to({points[first], random() % 2 == 0}, options);
      if (trial % 2 == 1) state = run.up_to({points[second], false}, options, state);
      REQUIRE_FALSE(state.empty());
      const RunStatistics statistics = run.from(state, options);
      check_same(trace.text(), whole.trace.text());
      CHECK(counts(statistics, saves_each_step) == counts(whole.statistics, saves_each_step));
    }
  }
}

TEST_CASE("a run that goes on with other variables is the run that had them from the beginning") {
  std::mt19937 random;
  for (unsigned seed = 0; seed < kCutSystems; ++seed) {
    const Assembly assembly = system_of(seed);
    const System system(assembly.declaration());
    RunOptions before = options_of(seed, assembly, system);
    RunOptions after = before;
    before.recorded = some_variables(system, random);
    add_sampled(system, before.recorded);
    after.recorded = some_variables(system, random);
    after.watched = some_variables(system, random);
    const Whole whole = run_whole(assembly, system, after);
    const std::vector<Time>& points = whole.trace.points();
    for (int trial = 0; trial < 4; ++trial) {
      const Pause first{points[random() % points.size()], random() % 2 == 0};
      INFO("seed " << seed << ", " << after.step.policy->name << ", cut at "
                   << to_seconds(first.time) << " s\n"
                   << assembly.text());
      Trace known(system), ignored(system), trace(system);
      REQUIRE_FALSE(
          CutRun{system, share(assembly.instantiate()), known}.up_to(first, after).empty());
      CutRun run{system, share(assembly.instantiate()), ignored};
      std::vector<std::byte> state = run.up_to(first, before);
      REQUIRE_FALSE(state.empty());
      CutRun rest{system, run.units, trace};
      if (trial % 2 == 1) {
        const std::size_t then = random() % points.size();
        const Pause second{std::max(points[then], first.time), false};
        state = rest.up_to(second, after, state);
        REQUIRE_FALSE(state.empty());
      }
      const RunStatistics statistics = rest.from(state, after);
      check_same(known.text() + trace.text(), whole.trace.text());
      CHECK(counts(statistics, false) == counts(whole.statistics, false));
    }
  }
}

TEST_CASE("pauses change nothing") {
  std::size_t count = 0;
  for (unsigned seed = 0; seed < kCutSystems / 4; ++seed) {
    const Assembly assembly = system_of(seed);
    const System system(assembly.declaration());
    const RunOptions options = options_of(seed, assembly, system);
    INFO("seed " << seed << "\n" << assembly.text());
    const Whole whole = run_whole(assembly, system, options);
    Trace trace(system);
    ManyPauses pauses;
    Simulation simulation(system, assembly.instantiate(), options);
    simulation.add_observer(trace);
    simulation.set_control(pauses);
    try {
      simulation.run();
    } catch (const Error& error) {
      trace.note(error);
    }
    count += pauses.pauses;
    check_same(trace.text(), whole.trace.text());
    CHECK(counts(simulation.statistics(), true) == counts(whole.statistics, true));
  }
  CHECK(count > 5 * kCutSystems);
}

TEST_CASE("what is added in a pause has the effect that it would have had from the beginning") {
  for (unsigned seed = 0; seed < kCutSystems / 2; ++seed) {
    const Assembly assembly = system_of(seed);
    const System system(assembly.declaration());
    RunOptions options = options_of(seed, assembly, system);
    options.interventions = random_interventions(assembly, seed);
    if (options.interventions.empty()) continue;
    INFO("seed " << seed << "\n" << assembly.text());
    const Whole whole = run_whole(assembly, system, options);
    Adder adder(std::exchange(options.interventions, {}));
    Trace trace(system);
    Simulation simulation(system, assembly.instantiate(), options);
    adder.simulation = &simulation;
    simulation.add_observer(trace);
    simulation.set_control(adder);
    try {
      simulation.run();
    } catch (const Error& error) {
      trace.note(error);
    }
    check_same(trace.text(), whole.trace.text());
  }
}

TEST_CASE("a state that is damaged is refused, or is another one, and never crashes") {
  std::mt19937 random;
  std::size_t refused = 0, other = 0;
  for (unsigned seed = 0; seed < kCutSystems; ++seed) {
    const Assembly assembly = system_of(seed);
    const System system(assembly.declaration());
    RunOptions options = options_of(seed, assembly, system);
    options.threads = {};
    for (int trial = 0; trial < 8; ++trial) {
      Trace trace(system);
      trace.most_points = 2000;
      CutRun run{system, share(assembly.instantiate()), trace};
      const Time time = Time(std::chrono::microseconds(random() % 20'000));
      std::vector<std::byte> state = run.up_to({time, false}, options);
      INFO("seed " << seed << ", trial " << trial);
      if (state.empty()) continue;  // it has failed before
      if (trial == 0) state.resize(random() % state.size());
      if (trial != 0) {
        state[random() % state.size()] ^= static_cast<std::byte>(1 << random() % 8);
      }
      if (state.empty()) continue;
      try {
        run.from(state, options);
        ++other;
      } catch (const BadState&) {
        ++refused;
      }
    }
  }
  INFO(refused << " were refused, " << other << " were another state");
  CHECK(refused > 2 * kCutSystems);
  CHECK(other > kCutSystems);
}
