// What a scenario demands of its run: the table, run.json, the test report and the exit code.
#include <csignal>

#include <nlohmann/json.hpp>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using nlohmann::json;

namespace {

/// A filter that rises to 1, a ticker that ticks each 0.141 s, and who listens to it.
Workspace watched(const std::string& checks, const std::string& more = "") {
  const std::string message = connection("ticker.tick.clock", "listener.message.clock") +
                              connection("ticker.tick.number", "listener.message.number") +
                              connection("ticker.tick.picoseconds", "listener.message.picoseconds");
  return Workspace(Parts{component("filter", "minimal.fmu") + component("ticker", "ticker.fmu") +
                             component("listener", "listener.fmu") + more,
                         message, "<stride:Checks>\n" + checks + "</stride:Checks>\n"});
}

Outcome run(const Workspace& workspace, const Arguments& further = {}) {
  Arguments options{"--set", "filter.u=1",       "--set", "filter.time_constant=0.1",
                    "--set", "ticker.period=0.1"};
  options.insert(options.end(), further.begin(), further.end());
  return workspace.run(options);
}

const std::string kGood =
    "<stride:Always name='bounded' signal='filter.y' min='0' max='1'/>\n"
    "<stride:Count event='ticker.tick.number' equals='7'/>\n"
    "<stride:Answer request='ticker.tick.number' reply='listener.message.number' within='0'/>\n"
    "<stride:Final signal='listener.misplaced' equals='0'/>\n"
    "<stride:Eventually signal='filter.y' above='0.9' to='0.25'/>\n";
const std::string kBad = "<stride:Never name='low' signal='filter.y' above='0.5'/>\n";

json checks_of(const Workspace& workspace) { return run_json(workspace)["checks"]; }

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace

TEST_CASE("checks that pass are in the table of verdicts and in run.json") {
  const Workspace workspace = watched(kGood);
  const Outcome outcome = run(workspace);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("\nVerdicts\n  by ") && Contains("  bounded  ") &&
                              Contains("ticker.tick.number count = 7 ") &&
                              Contains("7 requests answered, after 0 s at most"));
  CHECK_THAT(outcome.out, !Contains("first failure"));
  CHECK_THAT(outcome.out, Contains("  verdict      margin  because") &&
                              Contains("  passed            0  it was between 0 and"));
  CHECK_THAT(outcome.out, Contains(" 0 messages  7 messages") && Contains(" 0 s  7 requests"));
  const json checks = checks_of(workspace);
  REQUIRE(checks.size() == 5);
  for (const json& check : checks) CHECK(check["passed"] == true);
  CHECK(checks[0]["name"] == "bounded");
  CHECK(checks[0]["kind"] == "always");
  CHECK(checks[0]["time"].is_null());
  CHECK(checks[0]["values"].empty());
  CHECK(checks[0]["margin"] == json::parse(R"({"value": 0, "unit": "", "at": 0})"));
  CHECK(checks[0]["limits"] ==
        json::parse(R"({"signal": "filter.y", "from": null, "to": null, "min": 0, "max": 1})"));
  CHECK(checks[1]["text"] == "7 messages");
  CHECK(checks[1]["margin"] == json::parse(R"({"value": 0, "unit": "messages", "at": 1})"));
  CHECK_FALSE(checks[1].contains("limits"));
  CHECK(checks[2]["margin"]["unit"] == "s");
  CHECK(checks[4]["limits"]["to"] == 0.25);
  CHECK(checks[4]["kind"] == "eventually");
}

TEST_CASE("a check that fails: the first instant and the value there, and the exit code 1") {
  const Workspace workspace = watched(kGood + kBad);
  const Outcome outcome = run(workspace);
  CHECK(outcome.exit_code == 1);
  const Csv signals = workspace.signals();
  const std::string value = signals.row(70)[signals.column("filter.y")];
  CHECK(signals.number(69, signals.column("filter.y")) <= 0.5);
  CHECK_THAT(outcome.out,
             Contains("first failure [s]") && Contains("FAILED") && Contains(" 0.07 "));
  CHECK_THAT(outcome.err, EndsWith("stride: error: the run is complete, and has failed by 1 of 6 "
                                   "verdicts\n  " +
                                   workspace.at("<stride:Never") + "low: at 0.07 s: " + value +
                                   "; expected never > 0.5\n"));
  const json check = checks_of(workspace)[5];
  CHECK(check["passed"] == false);
  CHECK(check["time"] == 0.07);
  CHECK(check["line"].get<int>() > 10);
  const auto last = signals.row(signals.size() - 1);
  CHECK(check["margin"]["value"] == 0.5 - std::stod(last[signals.column("filter.y")]));
  CHECK(check["margin"]["at"] == 1);
  CHECK(check["values"] ==
        json::parse(R"([{"signal": "filter.y", "unit": "", "value": )" + value + "}]"));
  CHECK(run_json(workspace)["outcome"] == "completed");
}

TEST_CASE("what is checked need not be recorded, and is not recorded because of it") {
  const Workspace workspace =
      watched("<stride:Always signal='filter.time_constant' equals='0.1'/>" + kBad);
  CHECK(run(workspace, {"--signals", "listener.received"}).exit_code == 1);
  CHECK(workspace.signals().titles() == std::vector<std::string>{"time", "listener.received"});
  CHECK(checks_of(workspace)[0]["passed"] == true);
}

TEST_CASE("--no-checks judges by none, not even by what makes no sense") {
  const Workspace workspace = watched(kBad + "<stride:Final signal='filter.nothing' equals='1'/>");
  const Outcome outcome = run(workspace, {"--no-checks"});
  CHECK(outcome.exit_code == 0);
  CHECK(checks_of(workspace).empty());
}

TEST_CASE("checks change nothing in the run") {
  const Workspace workspace = watched(kGood + kBad);
  run(workspace, {"--no-checks"});
  const std::vector<std::string> files{"signals.csv", "events.csv", "signals.vcd"};
  std::vector<std::string> expected;
  for (const std::string& file : files) expected.push_back(workspace.result(file));
  CHECK(run(workspace).exit_code == 1);
  for (std::size_t i = 0; i < files.size(); ++i) CHECK(workspace.result(files[i]) == expected[i]);
}

TEST_CASE("idle skipping, threads, processes and unrecorded signals change no check") {
  const Workspace workspace = watched(kGood + kBad);
  run(workspace);
  const json expected = checks_of(workspace);
  const Arguments further =
      GENERATE(Arguments{"--no-idle-skip"}, Arguments{"--threads", "2"}, Arguments{"--isolate"},
               Arguments{"--signals", "ticker.level"});
  CHECK(run(workspace, further).exit_code == 1);
  CHECK(checks_of(workspace) == expected);
}

TEST_CASE("a run that --stop cuts short leaves open what it did not come to") {
  const Workspace workspace = watched(kGood + kBad);
  const Outcome outcome = run(workspace, {"--stop", "0.06"});
  CHECK(outcome.exit_code == 0);
  CHECK(count(outcome.out, "  undecided  ") == 6);
  CHECK_THAT(outcome.out, Contains("the run ended at 0.06 s, before this was decided"));
  CHECK(checks_of(workspace)[0]["passed"].is_null());
  CHECK(checks_of(workspace)[0]["margin"].is_null());
  CHECK(run(workspace, {"--stop", "0.3"}).exit_code == 1);
  const json checks = checks_of(workspace);
  CHECK((checks[0]["passed"].is_null() && checks[4]["passed"] == true));
  CHECK(checks[5]["time"] == 0.07);
}

TEST_CASE("in a run that fails, checks that have failed stay failed and are reported") {
  const Workspace workspace = watched(kBad + kGood, component("fuse", "thrower.fmu"));
  const Outcome outcome =
      run(workspace, {"--set", "fuse.throw_at=0.5", "--quiet", "--junit", "report.xml"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("checks have failed before the end of the run:") &&
                              Contains("low: at 0.07 s") && Contains("the fuse has blown"));
  const json checks = checks_of(workspace);
  CHECK(checks[0]["passed"] == false);
  CHECK(checks[1]["passed"].is_null());
  CHECK(checks[5]["passed"] == true);  // its interval was over
  const std::string report = read(workspace / "report.xml");
  CHECK_THAT(report, Contains("tests=\"7\" failures=\"1\" errors=\"1\" skipped=\"4\"") &&
                         Contains("<error message=\"") && Contains("the fuse has blown"));
}

TEST_CASE("an interrupted run: likewise") {
  const Workspace workspace = watched(kBad + "<stride:Final signal='filter.y' above='2'/>",
                                      component("judge", "judge.fmu"));
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace", "--junit",
                                                           "report.xml", "--set", "filter.u=1",
                                                           "--set", "ticker.period=0.1"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  CHECK_THAT(read(workspace / "report.xml"), Contains("the run has not ended"));
  process.send(SIGINT);
  CHECK(process.wait().exit_code == 1);
  const json checks = checks_of(workspace);
  CHECK(checks[0]["passed"] == false);
  CHECK(checks[1]["passed"].is_null());
  const json verdicts = run_json(workspace)["verdicts"];
  REQUIRE(verdicts.size() == 1);
  CHECK((verdicts[0]["component"] == "judge" && verdicts[0]["passed"].is_null()));
  CHECK_THAT(read(workspace / "report.xml"),
             Contains("<error message=\"the run was interrupted at ") &&
                 Contains("tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"2\""));
}

TEST_CASE("what is printed comes before the error, where both go to one file") {
  const Workspace workspace = watched(kBad);
  Arguments command{"/bin/sh", "-c", "\"$0\" \"$@\" > both.log 2>&1"};
  const Arguments failing = stride_command(
      Workspace::run_arguments({"--set", "filter.u=1", "--set", "filter.time_constant=0.1"}));
  command.insert(command.end(), failing.begin(), failing.end());
  CHECK(Process(command, workspace.scratch().path()).wait().exit_code == 1);
  CHECK_THAT(read(workspace / "both.log"),
             Contains("Results in out: ") && Contains("report.html\nstride: error: "));
}

TEST_CASE("--junit: a test case for the run, each unit's verdict and each check") {
  const Workspace workspace = watched(kGood + kBad, component("judge", "judge.fmu"));
  CHECK(run(workspace, {"--junit", "reports/new/report.xml"}).exit_code == 1);
  const std::string report = read(workspace / "reports/new/report.xml");
  CHECK(count(report, "<testcase ") == 8);
  CHECK(count(report, "<failure ") == 1);
  CHECK_THAT(report, Contains("<testsuite name=\"test\"") &&
                         Contains("tests=\"8\" failures=\"1\" errors=\"0\" skipped=\"0\"") &&
                         Contains("<testcase name=\"run\" classname=\"test\"") &&
                         Contains("<testcase name=\"judge\" classname=\"test.units\"") &&
                         Contains("<testcase name=\"low\" classname=\"test.checks\"") &&
                         Contains("<failure message=\"at 0.07 s: ") && Contains("filter.y = 0.5") &&
                         Contains("<property name=\"outcome\" value=\"completed\"/>") &&
                         Contains("<property name=\"margin: bounded\" value=\"0\"/>") &&
                         Contains("<property name=\"margin: low\" value=\"-0.49"));
}

TEST_CASE("--junit: where there was no run, the report says why") {
  const Workspace workspace(Parts{component("nobody", "nowhere.fmu")});
  const Outcome outcome = workspace.run({"--junit", "report.xml"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(read(workspace / "report.xml"),
             Contains("tests=\"1\" failures=\"0\" errors=\"1\"") && Contains("nowhere.fmu"));
}

TEST_CASE("--junit: a file that cannot be written is reported before the run") {
  const Workspace workspace = watched(kGood);
  CHECK_THAT(input_error_of(run(workspace, {"--junit", "test.ssd/report.xml"})),
             Contains("test.ssd/report.xml") && Contains("the folder of this file does not exist"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("mistakes in checks are reported with file and line, all at once") {
  const Workspace workspace = watched(
      "<stride:Always signal='filter.z' min='0'/>\n"
      "<stride:Always signal='ticker.tick.number' min='0'/>\n"
      "<stride:Count event='filter.y' min='1'/>\n"
      "<stride:Final signal='filter.y' min='2' max='1'/>\n"
      "<stride:Always signal='filter.y' max='1' from='2'/>\n");
  const std::string message = input_error_of(run(workspace));
  CHECK_THAT(message, Contains("there are 5 mistakes") &&
                          Contains(workspace.at("filter.z") + "there is no signal 'filter.z'") &&
                          Contains("belongs to a clock") && Contains("is not a message") &&
                          Contains("no value fits min 2 and max 1") &&
                          Contains("from: 2 s is behind the end of the run, at 1 s"));
  CHECK_THAT(input_error_of(run(watched("<stride:Alwais signal='filter.y' min='0'/>"))),
             Contains("<stride:Alwais> is not known in <stride:Checks>"));
}

TEST_CASE("'stride check' lists them") {
  const Workspace workspace = watched(kGood);
  const Outcome outcome = workspace.stride({"check", "test.ssd"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("\nChecks\n  check ") &&
                              Contains("filter.y always >= 0 and <= 1") &&
                              Contains("ticker.tick.number answered by listener.message.number "
                                       "within 0 s"));
  CHECK_THAT(Workspace(two_filters()).stride({"check", "test.ssd"}).out, !Contains("Checks"));
}
