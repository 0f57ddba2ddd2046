// What a run shows while it goes.
#include <csignal>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// Throws for a line that is not an object.
std::vector<json> objects(const std::string& lines) {
  std::vector<json> objects;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) objects.push_back(json::parse(line));
  return objects;
}

/// A unit that is left alone for most of a run.
Workspace resting() {
  return Workspace(
      Parts{component("environment", "environment.fmu") + component("filter", "minimal.fmu")});
}

}  // namespace

TEST_CASE("the progress of a run is printed for programs") {
  const Workspace workspace = resting();
  const Outcome outcome =
      workspace.run({"--quiet", "--progress=json", "--stop", "300", "--no-trace"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "");
  const std::vector<json> seen = objects(outcome.err);
  REQUIRE(seen.size() >= 2);
  CHECK(seen.front()["time"] == 0);
  CHECK(seen.front()["left"].is_null());
  for (std::size_t i = 1; i < seen.size(); ++i) {
    INFO(seen[i]);
    CHECK(seen[i]["time"] >= seen[i - 1]["time"]);
    CHECK(seen[i]["wall_time"] > seen[i - 1]["wall_time"]);
    CHECK(seen[i]["share"] == seen[i]["time"].get<double>() / 300);
    CHECK(seen[i]["skipped"] >= 0);
    CHECK(seen[i]["skipped"] <= 1);
    CHECK(seen[i].contains("outcome") == (i + 1 == seen.size()));
    if (i + 1 == seen.size()) continue;
    const double left = (300 - seen[i]["time"].get<double>()) / seen[i]["speed"].get<double>();
    CHECK(seen[i]["left"] == Approx(left));
  }
  const json& last = seen.back();
  CHECK(last["outcome"] == "completed");
  CHECK(last["share"] == 1);
  CHECK(last["left"].is_null());
  CHECK(last["speed"] == Approx(300 / last["wall_time"].get<double>()));
  double skipped = 0;
  const json run = run_json(workspace);
  for (const json& unit : run["units"]) {
    if (unit.contains("idle")) skipped += unit["idle"]["skipped"].get<double>();
  }
  CHECK(skipped > 100);
  CHECK(last["skipped"] == Approx(skipped / 600));
}

TEST_CASE("a log gets a plain line") {
  const Workspace workspace = resting();
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, StartsWith("100.0 % of 1 s simulated, ") &&
                              Contains(" times real time, ") && EndsWith(" % skipped\n"));
  CHECK(workspace.run({"--progress", "none"}).err == "");
  CHECK(workspace.run({"--quiet"}).err == "");
}

TEST_CASE("a terminal gets one line, which is rewritten") {
  const Workspace workspace = resting();
  std::string command;
  for (const std::string& word : stride_command(Workspace::run_arguments({})))
    command += word + " ";
  const Outcome outcome =
      Process({"script", "-qec", command, "/dev/null"}, workspace.scratch().path()).wait();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, StartsWith("\r  0.0 % of 1 s simulated\033[K\r"));
  const std::string last = outcome.out.substr(0, outcome.out.find('\n'));
  CHECK_THAT(last, Contains("\r100.0 % of 1 s simulated, ") && EndsWith(" % skipped\033[K\r"));
}

TEST_CASE("the last word is how the run ended") {
  SECTION("it failed") {
    const Workspace workspace(two_filters());
    fs::create_directory(workspace / "out");
    fs::create_symlink("/dev/full", workspace / "out" / "signals.csv");
    const Outcome outcome = workspace.run({"--progress=json"});
    CHECK(outcome.exit_code == 1);
    const std::string lines = outcome.err.substr(0, outcome.err.find("stride: error"));
    CHECK(objects(lines).back()["outcome"] == "failed");
  }
  SECTION("it was interrupted") {
    const Workspace workspace(two_filters());
    Process process(stride_command(Workspace::run_arguments(
                        {"--stop", "1e6", "--no-trace", "--progress=json"})),
                    workspace.scratch().path());
    await_first_results(process, workspace);
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, StartsWith("stride: warning: "));  // of so many steps
    const std::string lines = outcome.err.substr(outcome.err.find('{'));
    const json last = objects(lines.substr(0, lines.find("stride: error"))).back();
    CHECK(last["outcome"] == "interrupted");
    CHECK(last["share"] < 1);
    CHECK(last["time"] == run_json(workspace)["reached"]);
  }
}

TEST_CASE("a style of progress that there is not") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--progress", "bar"})),
             Contains("--progress bar: there is no such style") &&
                 Contains("it is auto, plain, json or none"));
}

TEST_CASE("a run in real time takes its time, and has the same results") {
  const Workspace workspace = resting();
  REQUIRE(workspace.run({"--quiet", "--stop", "0.4"}).exit_code == 0);
  const std::string signals = workspace.result("signals.csv");
  const Outcome outcome = workspace.run({"--progress=json", "--stop", "0.4", "--realtime", "2"});
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.result("signals.csv") == signals);
  std::string lines = outcome.err;
  if (const std::size_t warning = lines.find("stride: "); warning != std::string::npos) {
    lines.resize(warning);  // on a machine that is busy
  }
  // from below: how long a machine takes is its own affair
  CHECK(objects(lines).back()["wall_time"] >= 0.2);
  CHECK_THAT(outcome.out + outcome.err, Contains("2 x real time: "));
}

TEST_CASE("a factor of real time that is none is refused") {
  const Outcome outcome = resting().run({"--realtime", "0"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("--realtime 0: expected") && Contains("above 0"));
}
