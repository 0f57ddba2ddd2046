// Every scenario with each of its units in a process of its own: the same bytes as in one process,
// and the golden results.
#include <filesystem>
#include <set>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/build.h"
#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

const Arguments kCoarse{"--step", "0.01"};  // to the end
const Arguments kShort{"--step", "0.01", "--stop", "4"};
const std::set<std::string> kFull{"nfc_jitter", "nfc_two_tags", "replay_sensor"};

Arguments operator+(Arguments arguments, const Arguments& further) {
  arguments.insert(arguments.end(), further.begin(), further.end());
  return arguments;
}

std::size_t hosted_units(const ScenarioRun& run) {
  std::size_t count = 0;
  const auto json = nlohmann::json::parse(text_of(run.file("run.json")));
  for (const auto& unit : json["units"]) {
    count += unit.contains("host");
  }
  return count;
}

void check_same(const std::string& scenario, const Arguments& options,
                const Arguments& hosting = {"--isolate"}) {
  INFO(scenario);
  const Arguments all = Arguments{"--no-trace"} + without_judge(scenario) + options;
  const ScenarioRun in_process(scenario, all);
  const ScenarioRun hosted(scenario, all + hosting);
  CHECK(hosted_units(in_process) == 0);
  CHECK(hosted_units(hosted) >= 2);
  for (const char* file : {"signals.csv", "events.csv"}) {
    INFO(file);
    const bool is_same = text_of(hosted.file(file)) == text_of(in_process.file(file));
    CHECK(is_same);
  }
}

}  // namespace

TEST_CASE("processes for all units change no byte of any scenario's results") {
  REQUIRE(golden_scenarios().size() >= 7);
  for (const std::string& scenario : golden_scenarios()) {
    check_same(scenario, kCoarse + Arguments{"--no-idle-skip"});
  }
}

TEST_CASE("hosts change no result where idle units are skipped") {
  for (const std::string& scenario : golden_scenarios()) check_same(scenario, kShort);
}

TEST_CASE("units behind stride serve change no byte of any scenario's results") {
  const std::string place = "*=exec:exec " + stride_program().string() + " serve";
  for (const std::string& scenario : golden_scenarios()) {
    check_same(scenario, kShort, {"--at", place});
  }
}

TEST_CASE("hosts change no result on two threads, nor if only some units are hosted") {
  const Arguments stop{"--stop", "0.5"};
  check_same("nfc_two_tags", stop + Arguments{"--threads", "2"});
  check_same("nfc_two_tags", stop, {"--isolate=sensor*", "--isolate=channel"});
}

TEST_CASE("the golden results are those of units in processes, too") {
  for (const std::string& scenario : kFull) {
    INFO(scenario);
    const ScenarioRun run(scenario, {"--no-trace", "--no-idle-skip", "--isolate"});
    CHECK(golden_differences(scenario, run) == "");
  }
}
