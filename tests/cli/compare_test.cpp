// stride compare from outside: what is equal, what differs first, and why.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// The results of two runs of one scenario, in a/ and b/.
struct TwoRuns {
  Workspace workspace{two_filters()};

  explicit TwoRuns(const Arguments& a = {}, const Arguments& b = {}) {
    run("a", a);
    run("b", b);
  }
  void run(const std::string& folder, const Arguments& further) const {
    Arguments arguments{"run", "test.ssd", "--out", folder, "--quiet", "--set", "first.u=1"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const Outcome outcome = workspace.stride(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
  }
  Outcome compare(const Arguments& further = {}) const {
    Arguments arguments{"compare", "a", "b"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return workspace.stride(arguments);
  }
  std::string error(const Arguments& further = {}) const {
    return input_error_of(compare(further));
  }
};

}  // namespace

TEST_CASE("two runs of one scenario are equal, and the answer is code 0") {
  const Outcome outcome = TwoRuns().compare();
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, StartsWith("equal: 2 signals in 1001 rows, 0 messages sent or received\n"
                                     "They were made from the same inputs.\nNot compared: dates"));
}

TEST_CASE("where they differ first is in the first line, and the input that differs is shown") {
  const TwoRuns runs({}, {"--set", "second.time_constant=0.5"});
  const Outcome outcome = runs.compare();
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, StartsWith("differ first at t = 0.002 s in signal second.y\n"));
  CHECK_THAT(outcome.out, !Contains("first.y"));
  CHECK_THAT(outcome.out, Contains("They were made from other inputs:\n"));
  CHECK_THAT(outcome.out, Contains("option  --set  none  second.time_constant=0.5\n"));
}

TEST_CASE("tolerances are of all signals or of some") {
  const TwoRuns runs({}, {"--set", "second.time_constant=0.999999"});
  CHECK(runs.compare().exit_code == 1);
  CHECK(runs.compare({"--absolute", "1e-5"}).exit_code == 0);
  CHECK(runs.compare({"--relative", "1e-5"}).exit_code == 0);
  CHECK(runs.compare({"--tolerance", "second.*=1e-5"}).exit_code == 0);
  CHECK(runs.compare({"--tolerance", "first.y=1e-5"}).exit_code == 1);
  CHECK(runs.compare({"--ignore", "second.y"}).exit_code == 0);
  CHECK(runs.compare({"--only", "first.*"}).exit_code == 0);
}

TEST_CASE("runs that step differently are compared as curves") {
  const TwoRuns runs({"--step", "0.01"}, {"--step", "0.005"});
  const Outcome rows = runs.compare();
  CHECK(rows.exit_code == 1);
  CHECK_THAT(rows.out, Contains("--time-tolerance 0 compares signals as curves"));
  const Outcome curves = runs.compare({"--time-tolerance", "0", "--absolute", "0.02"});
  CHECK(curves.exit_code == 0);
  CHECK_THAT(curves.out, Contains("step.size"));
  CHECK(runs.compare({"--time-tolerance", "0", "--absolute", "1e-6"}).exit_code == 1);
}

TEST_CASE("a golden folder has what is to be compared, with its tolerances") {
  const TwoRuns runs;
  for (const char* file : {"run.json", "activity.csv", "signals.vcd", "report.html"}) {
    fs::remove(runs.workspace / "b" / file);
  }
  CHECK_THAT(runs.compare().out, Contains("file  run.json"));
  CHECK(runs.compare().exit_code == 1);
  CHECK(runs.compare({"--golden"}).exit_code == 0);
  runs.run("a", {"--set", "first.time_constant=0.9999"});
  CHECK(runs.compare({"--golden"}).exit_code == 1);
  runs.workspace.scratch().write("b/tolerances.csv",
                                 "signal,absolute,relative\nfirst.y,1e-3,0\nsecond.y,1e-3,0\n");
  CHECK(runs.compare({"--golden"}).exit_code == 0);
  runs.workspace.scratch().write("b/tolerances.csv", "signal,absolute,relative\nfirst.z,1,0\n");
  CHECK_THAT(runs.error({"--golden"}),
             Contains("b/tolerances.csv:2: 'first.z' is no signal of either run"));
}

TEST_CASE("--json has all of it, whether they differ or not") {
  const TwoRuns runs({}, {"--set", "second.time_constant=0.5"});
  CHECK(runs.compare({"--json", "c.json"}).exit_code == 1);
  const json comparison = json::parse(read(runs.workspace / "c.json"));
  CHECK(comparison["equal"] == false);
  CHECK(comparison["a"] == "a");
  REQUIRE(comparison["differences"].size() == 1);
  CHECK(comparison["differences"][0]["name"] == "second.y");
  CHECK(comparison["differences"][0]["time"] == 0.002);
  CHECK(comparison["inputs"][0]["b"] == "second.time_constant=0.5");
  CHECK(runs.compare({"--json", "c.json", "--ignore", "second.y"}).exit_code == 0);
  CHECK(json::parse(read(runs.workspace / "c.json"))["equal"] == true);
}

TEST_CASE("the file of --json is none of the results") {
  const TwoRuns runs;
  CHECK_THAT(runs.error({"--json", "b/signals.csv"}), Contains("--json b/signals.csv"));
  CHECK(runs.compare().exit_code == 0);
}

TEST_CASE("--html is a page of both, and no file of the results nor that of --json") {
  const TwoRuns runs({}, {"--set", "second.time_constant=0.5"});
  CHECK(runs.compare({"--html", "c.html"}).exit_code == 1);
  CHECK_THAT(read(runs.workspace / "c.html"), Contains("\"name\":\"second.y\""));
  CHECK_THAT(runs.error({"--html", "a/report.html"}), Contains("--html a/report.html"));
  CHECK_THAT(runs.error({"--html", "c.html", "--json", "c.html"}), Contains("c.html"));
  CHECK_THAT(runs.error({"--html", "nowhere/c.html"}), Contains("nowhere"));
}

TEST_CASE("a table is of a bounded length, and --json has the rest") {
  const TwoRuns runs;
  std::string a = "time", b = "time";
  for (int i = 0; i < 30; ++i) a += ",x.s" + std::to_string(i);
  b = a + "\n0";
  a += "\n0";
  for (int i = 0; i < 30; ++i) {
    a += ",1";
    b += ",2";
  }
  runs.workspace.scratch().write("a/signals.csv", a + "\n");
  runs.workspace.scratch().write("b/signals.csv", b + "\n");
  const Outcome outcome = runs.compare({"--json", "c.json"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("  and 10 more; --json has all\n"));
  CHECK(json::parse(read(runs.workspace / "c.json"))["differences"].size() == 30);
}

TEST_CASE("what both values begin with is left out where it would hide the difference") {
  const TwoRuns runs;
  const std::string head = "time,index,component,variable,direction,payload,content\n";
  const std::string same(50, '7');
  runs.workspace.scratch().write("a/events.csv", head + "1,0,x,y,sent," + same + "aa,\n");
  runs.workspace.scratch().write("b/events.csv", head + "1,0,x,y,sent," + same + "bb,\n");
  CHECK_THAT(runs.compare().out, Contains("  …7777aa  …7777bb  "));
}

TEST_CASE("what is wrong with the input is an error with its place, and the answer is code 2") {
  const TwoRuns runs;
  CHECK_THAT(runs.error({"--ignore", "frist.y"}),
             Contains("--ignore 'frist.y' is no signal and no message of either run") &&
                 Contains("did you mean 'first.y'?"));
  CHECK_THAT(runs.error({"--absolute", "-1"}), Contains("--absolute -1: "));
  CHECK_THAT(runs.error({"--time-tolerance", "soon"}), Contains("--time-tolerance soon: "));
  CHECK_THAT(runs.error({"--time-tolerance", ""}), Contains("--time-tolerance "));
  CHECK_THAT(runs.error({"--tolerance", "first.y"}), Contains("expected SIGNAL=ABSOLUTE"));
  CHECK_THAT(input_error_of(runs.workspace.stride({"compare", "a", "c"})),
             Contains("c: this is not a folder"));
  CHECK_THAT(input_error_of(runs.workspace.stride({"compare", "a", "."})),
             Contains("there are no results in this folder"));
  runs.workspace.scratch().write("b/signals.csv", "time,first.y\n0,high\n");
  CHECK_THAT(runs.error(), Contains("b/signals.csv:2: ") && Contains("expected a number"));
}

TEST_CASE("a campaign is many runs: the error says what to compare instead") {
  const TwoRuns runs;
  runs.workspace.scratch().write("b/campaign.json", "{}");
  CHECK_THAT(runs.error(), Contains("b: this is a folder of many runs") &&
                               Contains("stride compare A/cases/000/000017"));
}
