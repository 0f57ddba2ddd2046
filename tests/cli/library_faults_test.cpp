// Libraries of units that end the process, or do not return, when they are unloaded or after the
// run: exit code 1, the rows of a complete run, and nothing left behind.
#include <cstdlib>

#include "tests/build.h"
#include "tests/cli/failures.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

Workspace with_library_faults() {
  return Workspace(Parts{component("filter", "minimal.fmu") + component("faulty", "faulty.fmu")});
}

/// For the library of the unit `faulty`: when it is unloaded ("unload"), or after the run ("exit").
Arguments library_does(const std::string& fault, const std::string& call, Arguments further = {}) {
  further.insert(further.end(),
                 {"--quiet", "--set", "faulty.fault=" + fault, "--set", "faulty.call=" + call});
  return further;
}

}  // namespace

TEST_CASE("a library that ends the process when it is unloaded, or after the run, is an error") {
  if (kSanitized) return;
  const Workspace workspace = with_library_faults();
  const auto [call, place] = GENERATE(table<std::string, std::string>({
      {"unload", " in the unloading of '"},
      {"exit", " in a destructor or an exit function of a library, after the command"},
  }));
  const auto [fault, end] = GENERATE(table<std::string, std::string>({
      {"abort", "signal 6 (SIGABRT) ends stride"},
      {"segfault", "signal 11 (SIGSEGV) ends stride"},
      {"_exit", "exit() ends stride"},
  }));
  const Outcome outcome = workspace.run(library_does(fault, call, {"--junit", "junit.xml"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: " + end + place));
  CHECK(last_time(workspace) == "1");
  CHECK(workspace.left_behind().empty());
  if (call != "unload") return;
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  CHECK(run["reached"] == 1);
  CHECK_THAT(run["error"].get<std::string>(), Contains(end + place));
  CHECK_THAT(read(workspace / "junit.xml"), Contains(end + place.substr(0, 20)));
  CHECK_THAT(workspace.result("report.html"), Contains(end + place.substr(0, 20)));
}

TEST_CASE("a hosted unit's library that ends its process when it is unloaded is an error") {
  const Workspace workspace = with_library_faults();
  const auto [fault, end] = GENERATE(table<std::string, std::string>({
      {"segfault", "its process was ended by signal 11 (SIGSEGV) in the unloading of its library"},
      {"_exit", "it ended its process with exit code 4 in the unloading of its library"},
  }));
  const Leftovers leftovers;
  const Outcome outcome = workspace.run(library_does(fault, "unload", {"--isolate"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'faulty', at 1 s: " + end));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK(last_time(workspace) == "1");
  CHECK(leftovers.all() == std::vector<std::string>{});
}

TEST_CASE("a crash in the unloading of a library hides no earlier error") {
  if (kSanitized) return;
  const Workspace workspace(
      Parts{component("faulty", "faulty.fmu") + component("fuse", "thrower.fmu")});
  const Outcome outcome = workspace.run(
      library_does("segfault", "unload", {"--set", "fuse.throw_at=0.5", "--junit", "junit.xml"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the fuse has blown") &&
                              Contains("SIGSEGV) ends stride in the unloading of '"));
  CHECK_THAT(run_json(workspace)["error"].get<std::string>(), Contains("the fuse has blown"));
  CHECK_THAT(read(workspace / "junit.xml"), Contains("the fuse has blown"));
}

TEST_CASE("a library that does not return when it is unloaded, or after the run, is cut off") {
  if (kSanitized) return;
  const Workspace workspace = with_library_faults();
  const auto start = [&](const char* call) {
    return Process(stride_command(library_does("sleep", call, {"run", "test.ssd", "--out", call})),
                   workspace.scratch().path());
  };
  Process unloading = start("unload"), leaving = start("exit");  // each takes 10 s
  for (Process* process : {&unloading, &leaving}) {
    const Outcome outcome = process->wait();
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("stride: error: stride has not ended for 10 s in "));
  }
  for (const char* folder : {"unload", "exit"}) {
    const Csv signals(workspace / (std::string(folder) + "/signals.csv"));
    CHECK(signals.row(signals.size() - 1).front() == "1");
  }
  CHECK_THAT(read(workspace / "unload/run.json"), Contains("\"outcome\": \"failed\""));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a library that forks when it is loaded, and returns in both processes, is of one run") {
  const Workspace workspace(Parts{component("meddler", "meddler.fmu")});
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string expected = workspace.result("signals.csv");
  const Leftovers leftovers;
  ::setenv("STRIDE_MEDDLE", "load fork", 1);
  const Outcome outcome = workspace.run({"--quiet"});
  ::unsetenv("STRIDE_MEDDLE");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(workspace.result("signals.csv") == expected);
  CHECK(leftovers.all() == std::vector<std::string>{});
}

TEST_CASE("a library that calls exit(0) after the run does not change the exit code") {
  const Workspace workspace(
      Parts{component("faulty", "faulty.fmu") + component("fuse", "thrower.fmu")});
  const Arguments options{"--quiet", "--set", "faulty.fault=exit with 0", "--set",
                          "faulty.call=exit"};
  const auto run = [&](const std::string& throw_at) {
    Arguments arguments = options;
    arguments.insert(arguments.end(), {"--set", "fuse.throw_at=" + throw_at});
    return workspace.run(arguments);
  };
  CHECK(run("10").exit_code == 0);
  const Outcome outcome = run("0.5");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the fuse has blown"));
}
