// Several futures of one run.
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/cli/course.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

/// A ticker that ticks each 0.141 s, who listens to it, and two low-passes in a row.
Parts talkers_and_filters() {
  return {component("ticker", "ticker.fmu") + component("listener", "listener.fmu") +
              component("a", "minimal.fmu") + component("b", "minimal.fmu"),
          connection("ticker.tick.clock", "listener.message.clock") +
              connection("ticker.tick.number", "listener.message.number") +
              connection("ticker.tick.picoseconds", "listener.message.picoseconds") +
              connection("a.y", "b.u")};
}

/// With a file futures.xml.
class BranchingWorkspace : public Workspace {
 public:
  BranchingWorkspace(const Parts& parts, const std::string& branches) : Workspace(parts) {
    scratch().write("futures.xml",
                    "<stride:Branches xmlns:stride=\"urn:org.stride:scenario:1\">\n" + branches +
                        "</stride:Branches>\n");
  }
  explicit BranchingWorkspace(const std::string& branches)
      : BranchingWorkspace(talkers_and_filters(), branches) {}
};

const char* const kThree =
    "<stride:Branch name='same'/>\n"
    "<stride:Branch name='other value'><stride:Set variable='a.u' value='3' at='0.5'/>\n"
    "</stride:Branch>\n"
    "<stride:Branch name='late'><stride:Drop variable='listener.message.number' from='0.6'/>\n"
    "<stride:Force variable='b.u' value='2' from='0.75' until='0.8'/></stride:Branch>\n";

/// Each branch is the run that has had its interventions from the beginning.
void check_branches(const Arguments& options) {
  const BranchingWorkspace workspace(kThree);
  Arguments arguments{"--quiet", "--set", "a.u=1", "--branch", "0.5:futures.xml"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto whole = [&](const std::string& name, const Arguments& interventions) {
    Arguments run{"run", "test.ssd", "--quiet", "--set", "a.u=1", "--out", name};
    run.insert(run.end(), interventions.begin(), interventions.end());
    REQUIRE(workspace.stride(run).exit_code == 0);
    return workspace / name;
  };
  const fs::path nominal = whole("nominal", {});
  check_same_results(nominal, workspace / "out");
  check_same_results(nominal, workspace / "out/branches/same");
  check_same_results(whole("set", {"--set-at", "a.u=3@0.5"}),
                     workspace / "out/branches/other value");
  check_same_results(
      whole("drop", {"--drop", "listener.message.number@0.6..", "--force", "b.u=2@0.75..0.8"}),
      workspace / "out/branches/late");
  CHECK(workspace.left_behind().empty());
}

}  // namespace

TEST_CASE("branches are what the whole runs would have been") { check_branches({}); }

TEST_CASE("branches run one after another, too") { check_branches({"--jobs", "1"}); }

TEST_CASE("branches of a run with hosts begin at a checkpoint") { check_branches({"--isolate"}); }

TEST_CASE("branches that change nothing at the start and before the end") {
  const BranchingWorkspace workspace("<stride:Branch name='same'/>\n");
  for (const std::string instant : {"0", "0.141", "0.9995"}) {
    CAPTURE(instant);
    const Outcome outcome = workspace.run({"--quiet", "--branch", instant + ":futures.xml"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    check_same_traces(workspace / "out", workspace / "out/branches/same");
  }
}

TEST_CASE("captured stimuli of a branch are in its folder") {
  const BranchingWorkspace workspace(kThree);
  REQUIRE(workspace
              .run({"--quiet", "--set", "a.u=1", "--capture", "b=stimuli.csv", "--branch",
                    "0.5:futures.xml"})
              .exit_code == 0);
  const std::string nominal = read(workspace / "stimuli.csv");
  CHECK(read(workspace / "out/branches/same/stimuli/b.csv") == nominal);
  CHECK(read(workspace / "out/branches/other value/stimuli/b.csv") != nominal);
}

TEST_CASE("the file of the branches is among what a run, and each branch, was made from") {
  const Arguments hosted = GENERATE(Arguments{}, Arguments{"--isolate"});
  const BranchingWorkspace workspace(kThree);
  Arguments words{"--quiet", "--set", "a.u=1", "--branch", "0.5:futures.xml"};
  words.insert(words.end(), hosted.begin(), hosted.end());
  REQUIRE(workspace.run(words).exit_code == 0);
  for (const char* const file : {"out/run.json", "out/branches/same/run.json"}) {
    const auto run = nlohmann::json::parse(read(workspace / file));
    const auto& sources = run["provenance"]["sources"];
    CHECK(std::ranges::count(sources, "the file of the branches",
                             [](const auto& source) { return source["what"]; }) == 1);
  }
}

TEST_CASE("a branch that fails is an error with its name, and the others are complete") {
  const BranchingWorkspace workspace(
      Parts{component("a", "minimal.fmu"), "",
            "<stride:Checks><stride:Never name='not too high' signal='a.y' above='0.5'/>"
            "</stride:Checks>\n"},
      "<stride:Branch name='high'><stride:Set variable='a.u' value='9' at='0.5'/></stride:Branch>\n"
      "<stride:Branch name='low'/>\n");
  const Outcome outcome = workspace.run({"--branch", "0.5:futures.xml"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("1 of 2 branches has failed") && Contains("high: "));
  CHECK_THAT(outcome.out, Contains("Branches from 0.5 s on"));
  const auto record = [&](const char* file) {
    return nlohmann::json::parse(read(workspace / file));
  };
  CHECK(record("out/branches/high/run.json")["outcome"] == "completed");
  CHECK(record("out/run.json")["outcome"] == "completed");
  CHECK(record("out/branches/low/run.json")["outcome"] == "completed");
}

TEST_CASE("a crash in a branch ends this branch, with its error and results") {
  const FaultOrder order("segfault", "step", "0.75");
  const BranchingWorkspace workspace(
      Parts{component("unit", "fmi3_faulty.fmu") + component("a", "minimal.fmu")},
      "<stride:Branch name='one'/>\n");
  const Outcome outcome = workspace.run({"--quiet", "--branch", "0.5:futures.xml"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);  // of the run itself, too
  const auto branch = nlohmann::json::parse(read(workspace / "out/branches/one/run.json"));
  CHECK(branch["outcome"] == "failed");
  CHECK_THAT(branch["error"].get<std::string>(), Contains("unit 'unit'") && Contains("SIGSEGV"));
  CHECK(read(workspace / "out/branches/one/signals.csv") == workspace.result("signals.csv"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("whatever ends a branch, the table and its run.json say why, and the others go on") {
  const auto [fault, reason] = GENERATE(table<std::string, std::string>(
      {{"segfault", "signal 11 (SIGSEGV) ends stride in fmi3DoStep"},
       {"exit with 0", "exit() ends stride in fmi3DoStep"},
       {"exit by system call", "ended its process, with code 0"},
       {"_exit", "ended its process, with code "},
       {"kill", "its process was killed by SIGKILL"},
       {"throw int", "fmi3DoStep returned fmi3Error"}}));
  CAPTURE(fault);
  const BranchingWorkspace workspace(
      Parts{component("c", "faulty.fmu"), ""},
      "<stride:Branch name='bad'><stride:Set variable='c.at' value='0.7' at='0.6'/>"
      "</stride:Branch>\n<stride:Branch name='good'/>\n");
  const Outcome outcome =
      workspace.run({"--progress", "none", "--set", "c.at=2", "--set", "c.call=step", "--set",
                     "c.fault=" + fault, "--branch", "0.5:futures.xml"});
  INFO(outcome.err << outcome.out);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("1 of 2 branches has failed\n  bad: ") && Contains(reason));
  CHECK_THAT(outcome.out, Contains("good    passed"));
  const auto branch = nlohmann::json::parse(read(workspace / "out/branches/bad/run.json"));
  CHECK(branch["outcome"] == "failed");
  CHECK_THAT(branch["error"].get<std::string>(), Contains(reason));
  CHECK(run_json(workspace)["outcome"] == "completed");
}

TEST_CASE("branches that are interrupted end with complete results") {
  Parts parts = talkers_and_filters();
  parts.experiment = "<ssd:DefaultExperiment stopTime=\"100000\"/>\n";
  const BranchingWorkspace workspace(parts, kThree);
  Process process(
      stride_command(Workspace::run_arguments({"--quiet", "--no-trace", "--step", "0.001",
                                               "--branch", "0.5:futures.xml", "--jobs", "2"})),
      workspace.scratch().path());
  const auto size = [&] {
    std::error_code none;
    return fs::file_size(workspace / "out/branches/same/signals.csv", none) + (none ? 1 : 0);
  };
  while (process.is_running() && size() < 100'000) std::this_thread::sleep_for(5ms);
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("interrupted"));
  const auto run = nlohmann::json::parse(read(workspace / "out/branches/same/run.json"));
  CHECK(run["outcome"] == "interrupted");
  const std::string signals = read(workspace / "out/branches/same/signals.csv");
  CHECK(signals.back() == '\n');
  CHECK_FALSE(fs::exists(workspace / "out/branches/late"));
}

TEST_CASE("mistakes in a file of branches are errors before the run, with their lines") {
  const auto error_of = [](const std::string& branches, const std::string& instant = "0.5") {
    const BranchingWorkspace workspace(branches);
    const std::string error =
        input_error_of(workspace.run({"--quiet", "--branch", instant + ":futures.xml"}));
    CHECK_FALSE(fs::exists(workspace / "out/signals.csv"));
    return error;
  };
  CHECK_THAT(error_of("<stride:Branch name='x'><stride:Set variable='a.v' value='3' at='0.5'/>"
                      "</stride:Branch>\n"),
             Contains("futures.xml:2: ") && Contains("a.v"));
  CHECK_THAT(error_of("<stride:Branch name='x'><stride:Set variable='a.u' value='3' at='0.4'/>"
                      "</stride:Branch>\n"),
             Contains("futures.xml:2: it begins at 0.4 s, before its branch does at 0.5 s"));
  CHECK_THAT(error_of("<stride:Branch name='x'/>\n<stride:Branch name='x'/>\n"),
             Contains("futures.xml:3: ") && Contains("two branches of the name 'x'"));
  CHECK_THAT(error_of("<stride:Branch name='a/b'/>\n"), Contains("not a plain file name"));
  CHECK_THAT(error_of("<stride:Branch name='x'><stride:Checks/></stride:Branch>\n"),
             Contains("futures.xml:2: "));
  CHECK_THAT(error_of(""), Contains("there is no branch"));
  CHECK_THAT(error_of("<stride:Branch name='x'/>\n", "2"), Contains("the run is from 0 s to 1 s"));
  const BranchingWorkspace workspace("<stride:Branch name='x'/>\n");
  CHECK_THAT(input_error_of(workspace.run({"--branch", "futures.xml"})),
             Contains("expected SECONDS:FILE"));
  CHECK_THAT(
      input_error_of(workspace.run({"--branch", "0.5:futures.xml", "--junit", "futures.xml"})),
      Contains("this is the file of the branches"));
  CHECK_THAT(input_error_of(workspace.run(
                 {"--branch", "0.5:futures.xml", "--junit", "out/branches/x/run.json"})),
             Contains("in the folder 'branches' of the results"));
  CHECK_THAT(input_error_of(workspace.run({"--branch", "0.5:nothing.xml"})),
             Contains("nothing.xml"));
  CHECK_THAT(input_error_of(workspace.run({"--branch", "0.5:futures.xml", "--checkpoint", "1"})),
             Contains("exclude each other"));
}

TEST_CASE("a run that ends before its branches begin says so") {
  const BranchingWorkspace workspace("<stride:Branch name='x'/>\n");
  const Outcome outcome =
      workspace.run({"--quiet", "--branch", "0.75:futures.xml", "--stop", "0.5"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("the run is from 0 s to 0.5 s"));
}
