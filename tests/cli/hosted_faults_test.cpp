// Units in processes of their own that harm these, or those around them, and processes that are
// killed from outside. How a unit may end its process is in faults_test.cpp.
#include <csignal>
#include <cstdlib>
#include <functional>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/cli/failures.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Two units, each in a process of its own; 1 s in steps of 1 ms.
Workspace hosted_beside_a_filter(const std::string& faulty = "faulty",
                                 const std::string& source = "faulty.fmu",
                                 const std::string& hosts = "<stride:Host components=\"*\"/>\n") {
  return Workspace(
      Parts{component("filter", "minimal.fmu") + component(faulty, source), "", hosts});
}

Arguments does(const std::string& fault, Arguments further = {}) {
  further.insert(further.end(), {"--set", "faulty.fault=" + fault, "--set", "faulty.at=0.5"});
  return further;
}

/// The error of a run that has to end at 0.5 s, with nothing left.
std::string error_of(const Workspace& workspace, const Arguments& options,
                     const std::string& last = "0.499") {
  const Leftovers leftovers;
  const std::string error = failure_of(workspace, options, last);
  CHECK(leftovers.all() == std::vector<std::string>{});
  return error;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// The run.json of a run that did not come to its end, up to where its results are complete.
nlohmann::json cut_run(const Workspace& workspace, const Outcome& outcome,
                       const Leftovers& leftovers) {
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(leftovers.all() == std::vector<std::string>{});
  CHECK(workspace.left_behind().empty());
  const nlohmann::json run = run_json(workspace);
  const Csv signals = workspace.signals();  // throws for a row that is cut
  CHECK(signals.number(signals.size() - 1, 0) == run["reached"]);
  return run;
}

/// The error of a run that has failed somewhere.
std::string error_of(const Workspace& workspace, const Outcome& outcome,
                     const Leftovers& leftovers) {
  const nlohmann::json run = cut_run(workspace, outcome, leftovers);
  CHECK(run["outcome"] == "failed");
  return run["error"];
}

/// The output of a run that has to succeed, with nothing left.
std::string said_by(const Workspace& workspace, const Arguments& options, Arguments before = {}) {
  const Leftovers leftovers;
  for (const std::string& argument : Workspace::run_arguments(options)) before.push_back(argument);
  const Outcome outcome = workspace.stride(before);
  INFO(outcome.err.substr(0, 2000));
  CHECK(outcome.exit_code == 0);
  CHECK(last_time(workspace) == "1");
  CHECK(leftovers.all() == std::vector<std::string>{});
  CHECK(workspace.left_behind().empty());
  return outcome.err;
}

}  // namespace

TEST_CASE(
    "a unit that ends its process, or hangs, when it is freed is an error of a complete run") {
  const Workspace workspace = hosted_beside_a_filter();
  const auto [fault, says] = GENERATE(table<std::string, std::string>({
      {"abort", "its process was ended by signal 6 (SIGABRT) in fmi3FreeInstance"},
      {"exit with 0", "it ended its process with exit code 0 in fmi3FreeInstance"},
      {"_exit", "it ended its process with exit code 4 in fmi3FreeInstance"},
      {"loop", "it took longer than 0.5 s in fmi3FreeInstance"},
      {"stop", "it took longer than 0.5 s in fmi3FreeInstance"},
  }));
  const Arguments options{"--unit-timeout", "0.5", "--set", "faulty.call=free"};
  CHECK_THAT(error_of(workspace, does(fault, options), "1"),
             Contains("unit 'faulty', at 1 s: " + says));
}

TEST_CASE("a unit that takes too long is ended") {
  const Workspace workspace = hosted_beside_a_filter();
  const std::string fault = GENERATE("loop", "stop");
  CHECK_THAT(error_of(workspace, does(fault, {"--unit-timeout", "0.3"})),
             Contains("unit 'faulty', at 0.499 s: it took longer than 0.3 s in fmi3DoStep") &&
                 Contains("it printed: now comes: " + fault));
}

TEST_CASE("a unit that allocates without end gets the memory that it is allowed") {
  if (kSanitized) return;  // AddressSanitizer needs memory of its own without end
  const Workspace workspace = hosted_beside_a_filter(
      "faulty", "faulty.fmu", "<stride:Host components=\"*\" memoryLimit=\"64\"/>\n");
  CHECK_THAT(error_of(workspace, does("allocate")),
             Contains("unit 'faulty', at 0.499 s: ") && Contains("std::bad_alloc"));
}

TEST_CASE("memory that the limit of a process does not cover counts, too") {
  if (kSanitized) return;
  const Workspace workspace = hosted_beside_a_filter(
      "faulty", "faulty.fmu", "<stride:Host components=\"*\" memoryLimit=\"64\"/>\n");
  const auto fault =
      GENERATE(as<std::string>(), "allocate shared", "allocate in children", "write nameless file");
  INFO(fault);
  CHECK_THAT(error_of(workspace, does(fault, {"--unit-timeout", "20"})),
             Contains("unit 'faulty', at 0.499 s: its processes took ") &&
                 Contains(" MiB of memory together, which is above the limit of 64 MiB, so they "
                          "were ended in fmi3DoStep"));
}

TEST_CASE("a unit with a memory limit cannot hide files on their way through a socket") {
  if (kSanitized) return;
  const Workspace workspace = hosted_beside_a_filter(
      "faulty", "faulty.fmu", "<stride:Host components=\"*\" memoryLimit=\"64\"/>\n");
  CHECK_THAT(
      error_of(workspace, does("send nameless files", {"--unit-timeout", "20"})),
      Contains("unit 'faulty', at 0.499 s: ") && Contains("cannot send a file: Permission denied"));
}

TEST_CASE("files in memory that a unit writes count") {
  if (kSanitized) return;
  const Workspace workspace = hosted_beside_a_filter(
      "faulty", "faulty.fmu", "<stride:Host components=\"*\" memoryLimit=\"64\"/>\n");
  std::string folder = "/dev/shm/stride-test-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) return;  // there is no such folder
  ::setenv("TMPDIR", folder.c_str(), 1);            // of the workspace, which sets it back
  const Outcome outcome =
      workspace.run(does("write temporary file", {"--quiet", "--unit-timeout", "20"}));
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("above the limit of 64 MiB"));
  fs::remove_all(folder);
}

TEST_CASE("run.json tells how memory is limited") {
  const Workspace workspace = hosted_beside_a_filter(
      "faulty", "faulty.fmu",
      "<stride:Host components=\"faulty\" memoryLimit=\"2000\" sandbox=\"false\"/>\n");
  REQUIRE(workspace.run({"--quiet", "--stop", "0.01"}).exit_code == 0);
  const nlohmann::json host = run_json(workspace)["units"][1]["host"];
  CHECK_THAT(host["protections"].dump(),
             Contains("at most 2000 MiB of memory: RLIMIT_DATA for each process, a watch over the "
                      "sum of all"));
}

TEST_CASE("a process of the unit that prints for ever does not hide that the unit has crashed") {
  const Workspace workspace = hosted_beside_a_filter();
  CHECK_THAT(error_of(workspace, does("die while another prints")),
             Contains("unit 'faulty', at 0.499 s: its process was ended by signal 11 (SIGSEGV)"));
}

TEST_CASE("what a unit prints is in the log, and holds nothing up") {
  const Workspace workspace = hosted_beside_a_filter();
  const std::string said = said_by(workspace, does("print"), {"--verbose"});
  CHECK(occurrences(said, ": line ") == 16384);
  CHECK(occurrences(said, "line 16383: .") == 1);
}

TEST_CASE("a unit that closes all files goes on without them") {
  const Workspace workspace = hosted_beside_a_filter();
  said_by(workspace, does("close files"));
}

TEST_CASE("what a unit has started goes with it, however far away it has gone") {
  const Workspace workspace = hosted_beside_a_filter();
  said_by(workspace, does("daemon"));
}

TEST_CASE("a unit that overwrites the shared memory harms itself only") {
  const Workspace workspace = hosted_beside_a_filter();
  CHECK_THAT(error_of(workspace, does("overwrite", {"--unit-timeout", "60"})),
             Contains("unit 'faulty', at 0.499 s: the unit's process has written into the shared "
                      "memory"));
}

TEST_CASE("a unit that overwrites the name of the function that it crashes in") {
  const Workspace workspace = hosted_beside_a_filter();
  CHECK_THAT(error_of(workspace, does("overwrite and abort", {"--unit-timeout", "60"})),
             Contains("has written into the shared memory in an unknown function"));
}

TEST_CASE("a unit in a sandbox cannot kill its parent") {
  const Workspace workspace = hosted_beside_a_filter();
  CHECK_THAT(error_of(workspace, does("kill parent")),
             Contains("unit 'faulty', at 0.499 s: ") &&
                 Contains("cannot kill the parent: Operation not permitted"));
}

TEST_CASE("a unit that kills its parent kills itself") {
  const Workspace workspace = hosted_beside_a_filter();
  const Leftovers leftovers;
  const Outcome outcome = workspace.run(does("kill parent", {"--no-sandbox", "--stop", "1e6"}));
  CHECK_THAT(error_of(workspace, outcome, leftovers),
             Contains("unit 'faulty', at ") && Contains("supervisor"));
}

// ---- Killed from outside ----

namespace {

/// A run that takes hours, and those who come from it.
struct LongRun {
  Leftovers leftovers;
  Workspace workspace = hosted_beside_a_filter();
  Process process{stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path()};

  LongRun() { await_first_results(process, workspace); }

  void kill_one_of(const std::string& name) const {
    const std::vector<pid_t> found = leftovers.processes(name);
    REQUIRE_FALSE(found.empty());
    ::kill(found.back(), SIGKILL);
  }

  /// The error of the run, which has ended by itself.
  std::string error() { return error_of(workspace, process.wait(), leftovers); }
};

}  // namespace

TEST_CASE("a unit's process that is killed from outside") {
  LongRun run;
  run.kill_one_of("faulty");
  CHECK_THAT(run.error(), Contains("unit 'faulty', at ") && Contains("SIGKILL"));
}

TEST_CASE("a supervisor that is killed from outside") {
  LongRun run;
  CHECK(run.leftovers.processes("unit-supervisor").size() == 2);
  run.kill_one_of("unit-supervisor");
  CHECK_THAT(run.error(), Contains("unit '") && Contains("supervisor"));
}

TEST_CASE("nothing stays of a run that is killed") {
  LongRun run;
  CHECK(run.leftovers.processes().size() == 6);
  run.process.send(SIGKILL);
  CHECK(run.process.wait().exit_code == -SIGKILL);
  CHECK(run.leftovers.after_a_while() == std::vector<std::string>{});
  CHECK(run.workspace.left_behind().empty());
}

TEST_CASE("nothing is left of a killed run with snapshots") {
  const Leftovers leftovers;
  // two that may stop early and have no state: one of them is saved before each step
  const Workspace workspace(
      Parts{component("a", "early_without_state.fmu") + component("b", "early_without_state.fmu")});
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  while (process.is_running() && leftovers.processes("b").size() < 2) {
  }
  CHECK(leftovers.processes("unit-supervisor").size() == 1);
  process.send(SIGKILL);
  CHECK(process.wait().exit_code == -SIGKILL);
  CHECK(leftovers.after_a_while() == std::vector<std::string>{});
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a run with hosts can be interrupted") {
  LongRun run;
  run.process.send(SIGINT);
  const nlohmann::json end = cut_run(run.workspace, run.process.wait(), run.leftovers);
  CHECK(end["outcome"] == "interrupted");
}
