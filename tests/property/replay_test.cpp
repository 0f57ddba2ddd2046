// What a component of any system received, played to it alone, is the same to it bit by bit.
#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "master/base/time_text.h"
#include "tests/build.h"
#include "tests/master/base/archive/support.h"
#include "tests/property/random_system.h"
#include "tests/property/replays.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kReplaySystems = kSanitized ? 10 : 100;
constexpr Duration kReplayStep = 1ms;
constexpr Time kReplayStop{100ms};

/// The values of one component's outputs at an instant.
std::vector<double> values_at(const Results& results, const std::string& component, Time time) {
  std::vector<double> values;
  const std::vector<double>& all = results.values.at(time);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (results.names[i].rfind(component + ".", 0) == 0) values.push_back(all[i]);
  }
  return values;
}

/// Those of its communication points at which it was in Event Mode.
std::set<std::string> event_times(const std::string& stimuli) {
  std::set<std::string> times;
  std::istringstream lines(stimuli.substr(stimuli.find("\ntime,")));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comma = line.find(',');
    if (comma + 1 < line.size() && std::isdigit(line[comma + 1]))
      times.insert(line.substr(0, comma));
  }
  return times;
}

/// What it received is in its stimuli.
std::string sent_by(const Results& results, const std::string& component) {
  std::string rows;
  std::istringstream lines(results.events);
  for (std::string line; std::getline(lines, line);) {
    const bool is_sent = line.find(",sent,") != std::string::npos;
    if (is_sent && line.find("," + component + ",") != std::string::npos) rows += line + "\n";
  }
  return rows;
}

core::RunOptions one_step() { return fixed_steps(kReplayStop.time_since_epoch(), kReplayStop); }

struct Replay {
  Results original, replayed;
  std::string stimuli, replayed_stimuli;
};

/// `max_skip`: of the component, in both runs.
Replay replay(const Assembly& system, const std::string& component, core::RunOptions options,
              std::optional<Duration> max_skip = std::nullopt) {
  const Scratch scratch;
  Replay result;
  core::RunOptions replay_options = one_step();
  replay_options.idle = {{std::nullopt, max_skip}, {}, {}, kReplayStop.time_since_epoch()};
  result.original = run(system, std::move(options), {{component, scratch / "stimuli.csv"}});
  result.stimuli = read(scratch / "stimuli.csv");
  const Assembly only = alone(system, component, player_of(scratch, scratch / "stimuli.csv"));
  result.replayed = run(only, replay_options, {{component, scratch / "again.csv"}});
  result.replayed_stimuli = read(scratch / "again.csv");
  return result;
}

/// Where it was left alone, the original has its outputs on their tangents until it is called.
void check_same_replay(const Replay& result, const std::string& component, bool may_rest = false) {
  CHECK(result.replayed.values.size() >= 2);
  CHECK(result.replayed_stimuli == result.stimuli);
  const std::set<std::string> events = event_times(result.stimuli);
  for (const auto& [time, all] : result.replayed.values) {
    if (may_rest && events.count(core::to_text(time)) == 0) continue;
    INFO(core::to_text(time) << " s");
    CHECK(values_at(result.replayed, component, time) ==
          values_at(result.original, component, time));
  }
  CHECK(sent_by(result.replayed, component) == sent_by(result.original, component));
}

}  // namespace

TEST_CASE("a replay is what the component saw and did, captured again it is the same file") {
  std::set<std::string> models;
  for (unsigned seed = 0; seed < kReplaySystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const auto& components = system.declaration().components;
    const auto& chosen = components[seed % components.size()];
    INFO("seed " << seed << ", " << chosen.name << "\n" << system.text());
    models.insert(chosen.description->model_name);
    check_same_replay(replay(system, chosen.name, fixed_steps(kReplayStep, kReplayStop)),
                      chosen.name);
  }
  if (!kSanitized) CHECK(models.size() >= 6);
}

TEST_CASE("a replay gives the same where steps follow events only, or an error, and are undone") {
  const auto policy = GENERATE(&core::kEventDrivenSteps, &core::kErrorControlledSteps);
  core::RunOptions options = fixed_steps(kReplayStep, kReplayStop);
  options.step.policy = policy;
  options.step.maximum = 5ms;
  options.step.relative_tolerance = options.step.absolute_tolerance = 1e-2;
  std::uint64_t undone = 0;
  unsigned compared = 0;
  for (unsigned seed = 0; compared < kReplaySystems / 5; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const auto& components = system.declaration().components;
    const bool can_go_back = std::all_of(components.begin(), components.end(), [](const auto& c) {
      return c.description->can_save_state;
    });
    if (policy == &core::kErrorControlledSteps && !can_go_back) continue;
    ++compared;
    const std::string& component = components[seed % components.size()].name;
    INFO("seed " << seed << ", " << component << "\n" << system.text());
    const Replay result = replay(system, component, options);
    check_same_replay(result, component);
    undone += result.original.statistics.undone_steps;
  }
  if (policy == &core::kErrorControlledSteps) CHECK(undone > 0);
}

TEST_CASE("a replay gives the same where the component was suspended while it was idle") {
  const auto max_skip = GENERATE(Duration(2ms), Duration(7ms), Duration(1s));
  const std::string announces = GENERATE("0", "1");
  Assembly system;
  system.add("pump", "ticker", {{"period", "0.006"}});
  system.add("clock", "ticker", {{"period", "0.0031"}, {"announces", announces}});
  system.add("tank", "idler",
             {{"rate", "5"}, {"period", "0.0215"}, {"announces", announces}, {"inflow", "0"}});
  system.wire("pump.level", "tank.inflow").wire("clock.tick.clock", "tank.ask");
  core::RunOptions options = fixed_steps(kReplayStep, kReplayStop);
  options.idle.max_skip.assign(3, max_skip);
  options.idle.least = kReplayStep;
  const Replay result = replay(system, "tank", options, max_skip);
  CHECK(result.original.units.at("tank").suspensions > 3);
  CHECK(result.original.units.at("tank").messages_sent > 3);
  CHECK(event_times(result.stimuli).size() > 20);
  check_same_replay(result, "tank", true);
}

TEST_CASE("a replay gives the same for values of time-based clocks, and for units of FMI 2.0") {
  const std::string component = GENERATE("controller", "periodic", "relaxation");
  Assembly system;
  system.add("wheel", "ticker", {{"period", "0.004"}, {"announces", "1"}});
  system.add("plant", "linear", {{"damping", "20"}, {"frequency", "30"}});
  system.add("controller", "sampled_controller", {{"period", "0.0033"}, {"shift", "0.0011"}});
  system.add("periodic", "periodic_controller");
  system.add("turner", "fmi2_turner", {{"turn", "0.0305"}});  // where it discards a step
  system.add("relaxation", "fmi2_relaxation", {{"k", "40"}});
  system.wire("controller.u", "plant.u").wire("plant.x", "controller.y");
  system.wire("wheel.level", "controller.r").wire("turner.y", "periodic.r");
  system.wire("plant.y", "periodic.y").wire("plant.x", "relaxation.u");
  INFO(component);
  const Replay result = replay(system, component, fixed_steps(kReplayStep, kReplayStop));
  CHECK(result.original.units.at("turner").rejections > 0);
  CHECK(result.stimuli.find("0.0305,step,") != std::string::npos);
  check_same_replay(result, component);
}
