// The report of a run, from outside: when it is there, what is in it, and how it is opened.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/cli/failures.h"
#include "tests/master/report/support.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using nlohmann::json;
using stride::report::data_of;
using stride::report::unpacked;

namespace {

json report_of(const Workspace& workspace) { return data_of(workspace.result("report.html")); }

/// The variable has this value until the end of the scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { ::unsetenv(name_); }

 private:
  const char* name_;
};

std::string written_by_browser(const fs::path& file) {
  using namespace std::chrono_literals;
  for (int i = 0; i < 10'000 && (!fs::exists(file) || fs::file_size(file) == 0); ++i) {
    std::this_thread::sleep_for(1ms);
  }
  return read(file);
}

Workspace with(const std::string& annotation) {
  Parts parts = two_filters();
  parts.annotation = annotation;
  return Workspace(parts);
}

}  // namespace

TEST_CASE("a run's report has what was recorded") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const json report = report_of(workspace);
  CHECK(report["stride"] == STRIDE_VERSION);
  CHECK(report["run"] == run_json(workspace));
  CHECK(report["notes"].empty());
  CHECK(report["rows"] == 1001);
  const Csv signals = workspace.signals();
  const std::vector<double> y = unpacked<double>(report["columns"].at(0)["values"]);
  REQUIRE(y.size() == signals.size());
  for (std::size_t i = 0; i < y.size(); ++i) CHECK(y[i] == signals.number(i, 1));
  CHECK(report["plots"] == json::parse(R"([{"title": "first", "signals": ["first.y"]},
                                           {"title": "second", "signals": ["second.y"]}])"));
  CHECK(report["diagram"]["connections"] ==
        json::parse(R"([{"from": "first.y", "to": "second.u", "kind": "value"}])"));
}

TEST_CASE("stride report makes the same page again, there or elsewhere") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string before = workspace.result("report.html");
  fs::remove(workspace / "out/report.html");
  const Outcome outcome = workspace.stride({"report", "out"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(outcome.out == "Report in out/report.html\n");
  CHECK(workspace.result("report.html") == before);
  CHECK(workspace.stride({"report", "out", "-o", "page.html"}).exit_code == 0);
  CHECK(read(workspace / "page.html") == before);
}

TEST_CASE("plots are those that the scenario names") {
  const Workspace workspace = with(
      "<stride:Plot title=\"Both\" signals=\"*.y\"/><stride:Plot title=\"T\" "
      "signals=\"first.y\"/>");
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK(report_of(workspace)["plots"] ==
        json::parse(R"([{"title": "Both", "signals": ["first.y", "second.y"]},
                        {"title": "T", "signals": ["first.y"]}])"));
  REQUIRE(workspace.run({"--quiet", "--signals", "second.y"}).exit_code == 0);
  CHECK(report_of(workspace)["plots"] ==
        json::parse(R"([{"title": "Both", "signals": ["second.y"]}])"));
}

TEST_CASE("a plot of what is not recorded is refused before the run") {
  const Workspace workspace = with("<stride:Plot title=\"U\" signals=\"first.u\"/>");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains(workspace.at("<stride:Plot") +
                      "the plot 'U' names 'first.u', which matches no signal that is recorded"));
}

TEST_CASE("a failed run has a report, with the error") {
  const Workspace workspace(Parts{component("fuse", "thrower.fmu")});
  REQUIRE(workspace.run({"--quiet", "--set", "fuse.throw_at=0.5"}).exit_code == 1);
  const json report = report_of(workspace);
  CHECK(report["run"]["outcome"] == "failed");
  CHECK_THAT(report["run"]["error"], Contains("the fuse has blown"));
  CHECK(report["rows"] == 500);
}

TEST_CASE("an interrupted run has a report") {
  const Workspace workspace(two_filters());
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(SIGINT);
  CHECK(process.wait().exit_code == 1);
  CHECK(report_of(workspace)["run"]["outcome"] == "interrupted");
}

TEST_CASE("of a killed run what is there is shown") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--no-report"}).exit_code == 0);
  fs::remove(workspace / "out/run.json");
  fs::resize_file(workspace / "out/signals.csv", fs::file_size(workspace / "out/signals.csv") - 3);
  const Outcome outcome = workspace.stride({"report", "out"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: run.json: this file is missing") &&
                              Contains("warning: signals.csv:1002: the last line was cut off"));
  CHECK(report_of(workspace)["rows"] == 1000);
  CHECK(report_of(workspace)["run"].is_null());
}

TEST_CASE("what a killed run leaves has nothing of the run before") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  fs::remove(workspace / "out/signals.csv");
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(SIGKILL);
  process.wait();
  CHECK_FALSE(fs::exists(workspace / "out/report.html"));
  CHECK(workspace.stride({"report", "out"}).exit_code == 0);
  CHECK(report_of(workspace)["run"]["outcome"] == "running");
}

TEST_CASE("the report can be left out") {
  const bool by_option = GENERATE(true, false);
  const Workspace workspace = with(by_option ? "" : "<stride:Results report=\"none\"/>");
  const Outcome outcome = workspace.run(by_option ? Arguments{"--no-report"} : Arguments{});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, !Contains("report.html"));
  CHECK_FALSE(fs::exists(workspace / "out/report.html"));
  CHECK_FALSE(run_json(workspace)["files"].contains("report"));
  CHECK(workspace.stride({"report", "out"}).exit_code == 0);
  CHECK(fs::exists(workspace / "out/report.html"));
}

TEST_CASE("results and report under other names are found again") {
  const Workspace workspace =
      with("<stride:Results signals=\"s.csv\" statistics=\"stats.json\" report=\"page.html\"/>");
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string before = workspace.result("page.html");
  CHECK(data_of(before)["rows"] == 1001);
  CHECK(workspace.stride({"report", "out"}).err == "");
  CHECK(workspace.result("page.html") == before);
}

TEST_CASE("a report that cannot be written is an error; all else is kept and printed") {
  const std::string limit = GENERATE("1e9", "-1");
  const Workspace workspace(Parts{component("judge", "judge.fmu")});
  fs::create_directories(workspace / "out/report.html/x");
  const Outcome outcome = workspace.run({"--set", "judge.limit=" + limit});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("out/report.html: this is a folder"));
  CHECK_THAT(outcome.out, Contains("Verdicts") && Contains("Results in out"));
  CHECK(run_json(workspace)["outcome"] == "completed");
}

TEST_CASE("a folder without results is refused") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.stride({"report", "tmp"})),
             Contains("tmp: there are no results in this folder"));
  CHECK_THAT(input_error_of(workspace.stride({"report", "none"})),
             Contains("none: this is not a folder"));
}

TEST_CASE("wrong results are refused with file and line") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  std::ofstream(workspace / "out/signals.csv") << "time,first.y,second.y\n0,a,0\n";
  CHECK_THAT(input_error_of(workspace.stride({"report", "out"})),
             Contains("out/signals.csv:2: column 'first.y': expected a number"));
}

TEST_CASE("the browser is given the page") {
  const Workspace workspace(two_filters());
  const fs::path script = workspace / "browser";
  std::ofstream(script) << "#!/bin/sh\nprintf %s \"$*\" > opened.new && mv opened.new opened\n";
  fs::permissions(script, fs::perms::owner_all);
  const fs::path page = fs::absolute(workspace / "out/report.html");
  SECTION("by run") {
    const Environment browser("BROWSER", "/no/such/program:" + script.string());
    CHECK(workspace.run({"--quiet", "--open"}).exit_code == 0);
    CHECK(written_by_browser(workspace / "opened") == page.string());
  }
  SECTION("by report, where the command says") {
    REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
    const Environment browser("BROWSER", script.string() + " --new %s --end");
    CHECK(workspace.stride({"report", "out", "--open"}).exit_code == 0);
    CHECK(written_by_browser(workspace / "opened") == "--new " + page.string() + " --end");
  }
}

TEST_CASE("without a browser the file to open is printed") {
  const Workspace workspace(two_filters());
  const Environment browser("BROWSER", "/no/such/program");
  const std::string hint =
      "hint: open " + fs::absolute(workspace / "out/report.html").string() + " in a browser";
  const Outcome run = workspace.run({"--quiet", "--open"});
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("warning: cannot open out/report.html") && Contains(hint));
  const Outcome report = workspace.stride({"report", "out", "--open"});
  CHECK(report.exit_code == 1);
  CHECK_THAT(report.err, Contains("BROWSER names no program") && Contains(hint));
}

TEST_CASE("what is not written cannot be opened") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--no-report", "--open"})),
             Contains("--open: this run writes no report"));
}

TEST_CASE("a report is written to the given file only") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  workspace.scratch().write("target.html", "");
  fs::create_symlink("target.html", workspace / "link.html");
  CHECK(workspace.stride({"report", "out", "-o", "link.html"}).exit_code == 0);
  CHECK(fs::is_symlink(workspace / "link.html"));
  CHECK_FALSE(read(workspace / "target.html").empty());
  CHECK(workspace.stride({"report", "out", "-o", "/dev/null"}).exit_code == 0);
  CHECK(fs::is_character_file("/dev/null"));

  std::string run = workspace.result("run.json");
  run.replace(run.find("\"report.html\""), 13, "\"../victim.html\"");
  workspace.scratch().write("out/run.json", run);
  const Outcome outcome = workspace.stride({"report", "out"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("'../victim.html' is not a file of this folder; the report is"));
  CHECK_FALSE(fs::exists(workspace / "victim.html"));
}

TEST_CASE("a run.json cannot make the report replace what is no page") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string name = GENERATE("signals.csv", "run.json", "notes.txt");
  std::ofstream(workspace / "out/notes.txt") << "mine";
  json run = run_json(workspace);
  run["files"]["report"] = name;
  std::ofstream(workspace / "out/run.json") << run.dump();
  const std::string before = workspace.result(name);
  const Outcome outcome = workspace.stride({"report", (workspace / "out").string()});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains(name));
  CHECK(workspace.result(name) == before);
}
