// Every scenario, cut at some instants: a run that goes on from a checkpoint leaves the same bytes.
#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

constexpr const char* kTraces[] = {"signals.csv", "events.csv", "signals.vcd", "activity.csv"};

/// Some are those of rows of the results, at and beside events; the others are anywhere.
std::set<std::string> instants(const fs::path& results, std::mt19937& random) {
  const Csv signals(results / "signals.csv");
  std::set<std::string> chosen;
  for (int i = 0; i < 2; ++i) chosen.insert(signals.row(random() % signals.size())[0]);
  const Csv activity(results / "activity.csv");
  for (int i = 0; i < 3 && activity.size() > 0; ++i) {
    chosen.insert(activity.row(random() % activity.size())[i % 2]);
  }
  const double last = std::stod(signals.row(signals.size() - 1)[0]);
  const double share = static_cast<double>(random() % 1000) / 1000;
  chosen.insert(fmt::format("{:.6f}", last * share));
  return chosen;
}

void check_same_traces(const fs::path& whole, const fs::path& other) {
  for (const char* const file : kTraces) {
    CAPTURE(file);
    const bool is_same = text_of(whole / file) == text_of(other / file);
    CHECK(is_same);
  }
}

Outcome run_scenario(const std::string& scenario, const fs::path& out, const Arguments& further) {
  Arguments arguments{"run",     (scenario_folder(scenario) / (scenario + ".ssd")).string(),
                      "--quiet", "--no-report",
                      "--out",   out.string()};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return run_program(arguments);
}

void check_cuts(const std::string& scenario, const Arguments& options, unsigned seed) {
  CAPTURE(scenario);
  const ScratchFolder folder;
  const Outcome first = run_scenario(scenario, folder / "whole", options);
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  std::mt19937 random(seed);
  Arguments with_checkpoints = options;
  for (const std::string& instant : instants(folder / "whole", random)) {
    with_checkpoints.insert(with_checkpoints.end(), {"--checkpoint", instant});
  }
  const Outcome second = run_scenario(scenario, folder / "cut", with_checkpoints);
  INFO(second.err);
  REQUIRE(second.exit_code == 0);
  check_same_traces(folder / "whole", folder / "cut");
  std::size_t resumed = 0;
  for (const auto& entry : fs::directory_iterator(folder / "cut/checkpoints")) {
    CAPTURE(entry.path().string());
    const Outcome outcome = run_program({"resume", entry.path().string(), "--quiet"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    check_same_traces(folder / "whole", folder / "cut");
    ++resumed;
  }
  CHECK(resumed >= 2);
}

}  // namespace

TEST_CASE("every scenario goes on from checkpoints to the same bytes") {
  unsigned seed = 1;
  for (const std::string& scenario : golden_scenarios()) check_cuts(scenario, {}, seed++);
}

TEST_CASE("scenarios with hosts go on from checkpoints to the same bytes") {
  for (const std::string scenario : {"nfc_jitter", "box_drop"}) {
    check_cuts(scenario, {"--step", "0.01", "--isolate"}, 5);
  }
}
