// Units that judge the run: what is printed, written, and the exit code.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace {

/// A filter that rises to 1 in the course of the run, and two that judge how far it comes.
Workspace two_judges() {
  return Workspace(Parts{component("filter", "minimal.fmu") + component("low", "judge.fmu") +
                             component("high", "judge.fmu"),
                         connection("filter.y", "low.u") + connection("filter.y", "high.u")});
}

const Arguments kRising{"--set", "filter.u=1", "--set", "filter.time_constant=0.1"};

Outcome judged(const Workspace& workspace, Arguments options) {
  options.insert(options.end(), kRising.begin(), kRising.end());
  return workspace.run(options);
}

}  // namespace

TEST_CASE("verdicts that are good are shown, and the exit code is 0") {
  const Workspace workspace = two_judges();
  const Outcome outcome = judged(workspace, {"--set", "low.limit=1.5"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, !Contains("error"));
  CHECK_THAT(outcome.out, Contains("\nVerdicts\n  by    verdict  because\n") &&
                              Contains("\n  low   passed   the limit was not reached\n") &&
                              Contains("\n  high  passed   the limit was not reached\n"));
  const auto verdicts = nlohmann::json::parse(workspace.result("run.json"))["verdicts"];
  CHECK(verdicts == nlohmann::json::parse(R"([
      {"component": "low", "passed": true, "text": "the limit was not reached"},
      {"component": "high", "passed": true, "text": "the limit was not reached"}])"));
}

TEST_CASE("a bad verdict is the exit code 1, and the results are complete") {
  const Workspace workspace = two_judges();
  const Outcome outcome = judged(workspace, {"--set", "low.limit=0.5"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("\n  low   FAILED   the limit was reached\n") &&
                              Contains("\n  high  passed   the limit was not reached\n") &&
                              Contains("Results in out:"));
  CHECK_THAT(outcome.err,
             EndsWith("stride: error: the run is complete, and has failed by 1 of 2 verdicts\n"
                      "  low: the limit was reached\n"));
  const auto json = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(json["outcome"] == "completed");
  CHECK_FALSE(json.contains("error"));
  CHECK(json["reached"] == 1);
  CHECK(json["verdicts"][0]["passed"] == false);
  CHECK(json["verdicts"][1]["passed"] == true);
  CHECK(workspace.signals().number(1000, workspace.signals().column("low.below")) == 0);
}

TEST_CASE("with --quiet only bad verdicts are printed") {
  const Workspace workspace = two_judges();
  const Outcome good = judged(workspace, {"--quiet"});
  CHECK((good.exit_code == 0 && good.out.empty() && good.err.empty()));
  const Outcome bad =
      judged(workspace, {"--quiet", "--set", "low.limit=0.5", "--set", "high.limit=0"});
  CHECK((bad.exit_code == 1 && bad.out.empty()));
  CHECK_THAT(bad.err, Contains("failed by 2 of 2 verdicts\n  low: ") && Contains("\n  high: "));
}

TEST_CASE("the verdict depends neither on the recorded signals nor on idle units") {
  const Workspace workspace = two_judges();
  const Outcome outcome =
      judged(workspace, {"--signals", "filter.y", "--no-idle-skip", "--set", "high.limit=0.5"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("\n  high: the limit was reached\n"));
}

TEST_CASE("in a run that failed verdicts are undecided") {
  const Workspace workspace(
      Parts{component("judge", "judge.fmu", "") + component("thrower", "thrower.fmu")});
  const Outcome outcome = workspace.run({"--set", "judge.limit=0"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, !Contains("verdict"));
  const auto json = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(json["outcome"] == "failed");
  REQUIRE(json["verdicts"].size() == 1);
  CHECK(json["verdicts"][0]["passed"].is_null());
}

TEST_CASE("a run without a judge prints nothing of verdicts") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, !Contains("erdict"));
  CHECK(nlohmann::json::parse(workspace.result("run.json"))["verdicts"].empty());
}

TEST_CASE("inspect shows which output is the verdict") {
  CHECK_THAT(run_program({"inspect", "judge.fmu"}).out,
             Contains("\nverdict on the run: below, explained by why\n"));
  CHECK_THAT(run_program({"inspect", "minimal.fmu"}).out, !Contains("verdict"));
}
