// The campaigns beside the scenarios: the first cases of each, and the commands that repeat them.
#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/build.h"
#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FirstCases {
  explicit FirstCases(const std::string& scenario)
      : file((scenario_folder(scenario) / (scenario + ".xosc")).string()) {
    const Outcome run = run_program({"campaign", "run", file, "--out", out(), "--cases",
                                     "0-" + std::to_string(kCount - 1), "--quiet"});
    INFO(run.err);
    REQUIRE(run.exit_code != 2);
    REQUIRE(run_program({"campaign", "status", file, "--out", out()}).exit_code == 0);
    std::istringstream lines(text_of(folder / "out/cases.jsonl"));
    std::string line;
    while (records.size() < kCount && std::getline(lines, line)) {
      records.push_back(json::parse(line));
    }
    REQUIRE(records.size() == kCount);
  }

  std::string out() const { return (folder / "out").string(); }

  /// A case is what the run is that its command begins.
  void check_command(std::size_t index) const {
    std::string command =
        run_program({"campaign", "plan", file, "--out", out(), "--case", std::to_string(index)})
            .out;
    CAPTURE(command);
    const std::string begin = "stride run ";
    REQUIRE(command.rfind(begin, 0) == 0);
    command.erase(command.find_last_not_of('\n') + 1);
    Process run({"sh", "-c",
                 "exec '" + stride_command({}).front() + "' run " + command.substr(begin.size()) +
                     " --quiet --no-report --out '" + (folder / "run").string() + "'"},
                fs::current_path());
    const Outcome outcome = run.wait();
    INFO(outcome.err);
    const bool has_passed = records[index]["outcome"] == "passed";
    CHECK(outcome.exit_code == (has_passed ? 0 : 1));
    const json of_run = json::parse(text_of(folder / "run/run.json"));
    CHECK(of_run["reached"] == records[index]["reached"]);
    CHECK(of_run["outcome"] == "completed");
  }

  static constexpr std::size_t kCount = 4;
  ScratchFolder folder;
  std::string file;
  std::vector<json> records;
};

}  // namespace

TEST_CASE("the campaign of nfc_approach: where this sensor works") {
  const FirstCases cases("nfc_approach");
  for (const json& record : cases.records) {
    CAPTURE(record);
    CHECK((record["outcome"] == "passed" || record["outcome"] == "failed"));
    CHECK(record["reached"] == 30);
    const json& aggregates = record["aggregates"];
    CHECK(aggregates["least_distance"] > 0.005);
    CHECK(aggregates["least_distance"] < 0.1);
    CHECK(aggregates["energy"] > 0);
  }
  cases.check_command(1);
}

TEST_CASE("the campaign of ur5e_approach: how well this arm has to be calibrated") {
  if (!fs::exists(unit_folder() / "ur5e_world.fmu")) {
    std::cout << "SKIPPED: there is no ur5e_world.fmu\n";
    return;
  }
  const FirstCases cases("ur5e_approach");
  for (const json& record : cases.records) {
    CAPTURE(record);
    CHECK((record["outcome"] == "passed" || record["outcome"] == "failed"));
    CHECK(record["reached"] == 8);
    CHECK(record["aggregates"]["distance_at_7_s"] > 0.005);
    CHECK(record["aggregates"]["distance_at_7_s"] < 0.3);
  }
  cases.check_command(0);
}
