// Units in processes of their own: how they are requested, and what is visible of it.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Of the components in run.json, those with processes of their own.
std::vector<std::string> hosted(const Workspace& workspace) {
  std::vector<std::string> names;
  const auto run = nlohmann::json::parse(workspace.result("run.json"));
  for (const auto& unit : run["units"]) {
    if (unit.contains("host")) names.push_back(unit["name"]);
  }
  return names;
}

/// Runs it, and returns who had a process.
std::vector<std::string> hosted(const Workspace& workspace, const Arguments& options) {
  Arguments all{"--quiet"};
  all.insert(all.end(), options.begin(), options.end());
  const Outcome outcome = workspace.run(all);
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  return hosted(workspace);
}

Parts with(Parts parts, const std::string& annotation) {
  parts.annotation = annotation;
  return parts;
}

/// Two units that return early, and have no state; 0.1 s.
Parts two_that_stop() {
  return {component("a", "early_without_state.fmu") + component("b", "early_without_state.fmu"), "",
          "<stride:Step size=\"0.01\"/>\n", "<ssd:DefaultExperiment stopTime=\"0.1\"/>\n"};
}
const Arguments kInstants{"--set", "a.instants=0.013 0.025 -1 -1 -1 -1 -1 -1", "--set",
                          "b.instants=0.012 0.027 0.071 -1 -1 -1 -1 -1"};

Arguments operator+(Arguments arguments, const Arguments& further) {
  arguments.insert(arguments.end(), further.begin(), further.end());
  return arguments;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("--isolate changes where units run, and no byte of the results") {
  const Workspace workspace(two_filters());
  const Arguments options{"--set", "first.u=1", "--stop", "0.1"};
  CHECK(hosted(workspace, options).empty());
  const std::string signals = workspace.result("signals.csv");
  CHECK(hosted(workspace, options + Arguments{"--isolate"}) == Names{"first", "second"});
  CHECK(workspace.result("signals.csv") == signals);
  CHECK(hosted(workspace, options + Arguments{"--isolate=sec*"}) == Names{"second"});
  CHECK(workspace.result("signals.csv") == signals);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("what follows --isolate is the scenario") {
  const Workspace workspace(two_filters());
  const Arguments rest{"test.ssd", "--out", "out", "--stop", "0.01", "--quiet"};
  CHECK(workspace.stride(Arguments{"run", "--isolate"} + rest).exit_code == 0);
  CHECK(hosted(workspace) == Names{"first", "second"});
  CHECK(
      workspace.stride(Arguments{"run", "--isolate=first", "--isolate=second"} + rest).exit_code ==
      0);
  CHECK(hosted(workspace) == Names{"first", "second"});
  CHECK_THAT(input_error_of(workspace.run({"--isolate=frist"})),
             Contains("'frist' matches no component") && Contains("did you mean 'first'?"));
}

TEST_CASE("the summary names those with processes, and run.json what they took") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run({"--isolate=second", "--stop", "0.01"});
  CHECK_THAT(outcome.out, Contains("\nProcesses of their own: second\n"));
  CHECK_THAT(workspace.run({"--stop", "0.01"}).out, !Contains("Processes of their own"));
  workspace.run({"--isolate=second", "--stop", "0.01"});
  const auto host = nlohmann::json::parse(workspace.result("run.json"))["units"][1]["host"];
  CHECK(host["memory"] > 0);
  CHECK_FALSE(host.contains("snapshots"));
  CHECK(host["protections"].size() + host["missing_protections"].size() > 0);
}

TEST_CASE("without a sandbox nothing protects the others") {
  const Workspace workspace(two_filters());
  hosted(workspace, {"--isolate", "--no-sandbox", "--stop", "0.01"});
  const auto host = nlohmann::json::parse(workspace.result("run.json"))["units"][1]["host"];
  CHECK(host["protections"].empty());
  CHECK(host["missing_protections"].empty());
}

TEST_CASE("the scenario chooses the units with a host; the command line takes precedence") {
  const Workspace workspace(
      with(two_filters(),
           "<stride:Host components=\"*\" timeout=\"20\" memoryLimit=\"4096\"/>\n"
           "<stride:Host components=\"first\" process=\"false\"/>\n"));
  CHECK(hosted(workspace, {"--stop", "0.01"}) == Names{"second"});
  CHECK(hosted(workspace, {"--stop", "0.01", "--isolate"}) == Names{"first", "second"});
}

TEST_CASE("check shows the units with a host, their settings and the reason") {
  const Workspace workspace(
      with(two_filters(),
           "<stride:Host components=\"second\" timeout=\"0.5\" memoryLimit=\"512\" "
           "sandbox=\"false\"/>\n"));
  const Outcome outcome = workspace.stride({"check", "test.ssd", "--isolate=first"});
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out,
             Contains("\nProcesses of their own\n"
                      "  component  call limit [s]  memory limit [MiB]  sandbox  why              "
                      "snapshots\n") &&
                 Contains("  first                none                none  yes      "
                          "--isolate=first  no: it saves its own state\n") &&
                 Contains("  second                0.5                 512  no       " +
                          workspace.at("<stride:Host").substr(0, 11)));
  CHECK_THAT(workspace.stride({"check", "test.ssd", "--isolate", "--unit-timeout", "3"}).out,
             Contains("  second                  3 "));
  const Workspace plain(two_filters());
  CHECK_THAT(plain.stride({"check", "test.ssd"}).out, !Contains("Processes of their own"));
}

TEST_CASE("a time limit without a process is a mistake") {
  const Workspace workspace(two_filters());
  for (const char* command : {"run", "check"}) {
    CHECK_THAT(input_error_of(workspace.stride({command, "test.ssd", "--unit-timeout", "5"})),
               Contains("--unit-timeout 5: no unit has a process of its own") &&
                   Contains("hint: use --isolate as well"));
  }
  CHECK_THAT(input_error_of(workspace.run({"--isolate", "--unit-timeout", "0"})),
             Contains("--unit-timeout 0: a time limit must be above 0 s"));
  CHECK_THAT(input_error_of(workspace.run({"--isolate", "--unit-timeout", "soon"})),
             Contains("--unit-timeout soon: 'soon' is not a number"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("a unit that has to be rolled back, and has no state, has a process") {
  const Workspace workspace(two_that_stop());
  const Outcome outcome =
      workspace.stride(Arguments{"--verbose", "run", "test.ssd", "--out", "out"} + kInstants);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("info: unit 'b' has a process of its own, whose snapshots roll it back: it "
                      "may return early, as others may, and cannot save its state"));
  CHECK(hosted(workspace) == Names{"b"});
  const auto host = nlohmann::json::parse(workspace.result("run.json"))["units"][1]["host"];
  CHECK(host["snapshots"]["made"] > 10);
  CHECK(host["snapshots"]["restored"] >= 2);
  CHECK(host["snapshots"]["most_kept"] == 1);
  CHECK_THAT(outcome.out, Contains("Processes of their own: b (") && Contains(" snapshots, "));
  const Csv signals = workspace.signals();
  for (const char* instant : {"0.012", "0.013", "0.025", "0.027", "0.071"}) {
    CHECK_NOTHROW(signals.row_at(instant));
  }
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out,
             Contains("for its snapshots  yes: it may return early, as others may") &&
                 Contains("a snapshot of its process is taken before each step"));
}

namespace {

/// The components of which the process has taken snapshots.
Names saved(const Workspace& workspace, const Arguments& options) {
  REQUIRE(hosted(workspace, options) == Names{"a", "b"});
  Names names;
  const nlohmann::json run = run_json(workspace);
  for (const auto& unit : run["units"]) {
    if (unit["host"].contains("snapshots")) names.push_back(unit["name"]);
  }
  return names;
}

}  // namespace

TEST_CASE("a host takes snapshots only where a unit may have to be rolled back") {
  const Arguments isolated{"--isolate", "--stop", "0.1"};
  CHECK(saved(Workspace(two_that_stop()), isolated) == Names{"b"});
  const Parts one_stops = with(two_that_stop(),
                               "<stride:Step size=\"0.01\"/>\n"
                               "<stride:EarlyReturn components=\"b\" allowed=\"false\"/>\n");
  const Workspace none(one_stops);
  CHECK(saved(none, isolated).empty());
  CHECK_THAT(
      none.stride({"check", "test.ssd", "--isolate"}).out,
      Contains("--isolate  no: it steps after the others; snapshots=\"true\" rolls it back"));
  CHECK(saved(none, isolated + Arguments{"--policy", "error-controlled"}) == Names{"a", "b"});
  const std::string both =
      component("a", "rejecter_without_state.fmu") + component("b", "rejecter_without_state.fmu");
  CHECK(saved(Workspace(Parts{both}), isolated).empty());
  const Workspace demanded(Parts{both, "", "<stride:Host components=\"*\" snapshots=\"true\"/>\n"});
  CHECK(saved(demanded, isolated) == Names{"b"});
  CHECK_THAT(demanded.stride({"check", "test.ssd", "--isolate"}).out,
             Contains("yes: snapshots=\"true\""));
}

TEST_CASE("error-controlled steps give hosts to units without a state") {
  const Workspace workspace(two_that_stop());
  const Arguments options = kInstants + Arguments{"--policy", "error-controlled"};
  CHECK(hosted(workspace, options) == Names{"a", "b"});
  CHECK_THAT(workspace.stride({"check", "test.ssd", "--policy", "error-controlled"}).out,
             Contains("steps that were too long are undone, and it cannot save its state"));
}

TEST_CASE("a unit that is to have no host has none") {
  const std::string step = "<stride:Step size=\"0.01\"/>\n";
  const Workspace first(
      with(two_that_stop(), step + "<stride:Host components=\"b\" process=\"false\"/>\n"));
  CHECK(hosted(first, kInstants) == Names{"a"});
  const Workspace both(
      with(two_that_stop(), step + "<stride:Host components=\"*\" process=\"false\"/>\n"));
  CHECK_THAT(input_error_of(both.run()), Contains("'a' and 'b' may both return early"));
  const Workspace no_snapshots(
      with(two_that_stop(), step + "<stride:Host components=\"*\" snapshots=\"false\"/>\n"));
  CHECK_THAT(input_error_of(no_snapshots.run()), Contains("'a' and 'b' may both return early"));
}

TEST_CASE("what a unit logs looks the same from there") {
  const Workspace workspace(Parts{component("warning", "raw")});
  make_raw_fmu(workspace.scratch(), "raw");
  const Arguments options{"--quiet", "--stop", "0.001"};
  const Outcome near = workspace.run(options);
  CHECK_THAT(near.err, Contains("warning: unit 'warning': ") && Contains("it gets hot"));
  const Outcome hosted = workspace.run(options + Arguments{"--isolate"});
  CHECK(hosted.exit_code == 0);
  CHECK(hosted.err == near.err);
}

TEST_CASE("a hosted unit that fails gives the same error") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("fuse", "thrower.fmu")});
  const Arguments options{"--quiet", "--set", "fuse.throw_at=0.5"};
  const Outcome near = workspace.run(options);
  CHECK(near.exit_code == 1);
  CHECK_THAT(near.err, Contains("the fuse has blown"));
  const std::string recorded = workspace.result("signals.csv");
  const Outcome hosted = workspace.run(options + Arguments{"--isolate"});
  CHECK(hosted.exit_code == 1);
  CHECK(hosted.err == near.err);
  CHECK(workspace.result("signals.csv") == recorded);
}

TEST_CASE("what a unit receives there is captured all the same") {
  const Workspace workspace(two_filters());
  const Arguments options{"--set", "first.u=1", "--stop",
                          "0.05",  "--capture", "second=stimuli.csv"};
  CHECK(hosted(workspace, options).empty());
  const std::string stimuli = read(workspace / "stimuli.csv");
  CHECK(hosted(workspace, options + Arguments{"--isolate"}) == Names{"first", "second"});
  CHECK(read(workspace / "stimuli.csv") == stimuli);
}

TEST_CASE("a unit of which there can be one per process has several") {
  const Workspace workspace(Parts{component("a", "single.fmu") + component("b", "single.fmu")});
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("can be instantiated only once per process") &&
                 Contains("<stride:Host components=\"b\"/>"));
  CHECK(hosted(workspace, {"--isolate=b", "--stop", "0.01"}) == Names{"b"});
  CHECK(hosted(workspace, {"--isolate", "--stop", "0.01"}) == Names{"a", "b"});
}

TEST_CASE("a unit that cannot be instantiated is named from there, too") {
  const Workspace workspace(Parts{component("unit", "raw_without_do_step")});
  make_raw_fmu(workspace.scratch(), "raw_without_do_step");
  const Outcome near = workspace.run();
  CHECK(near.exit_code == 2);
  const Outcome hosted = workspace.run({"--isolate"});
  CHECK(hosted.exit_code == 2);
  CHECK(hosted.err == near.err);
}
