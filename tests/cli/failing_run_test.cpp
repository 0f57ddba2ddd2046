// Runs that fail on the way: exit code 1, who failed when and why, and complete results up to
// there.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/cli/failures.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> kFiles{"signals.csv", "events.csv", "signals.vcd", "activity.csv",
                                      "run.json"};

Workspace beside_a_filter(const std::string& name, const std::string& source,
                          const std::string& connections = "") {
  return Workspace(
      Parts{component("filter", "minimal.fmu") + component(name, source), connections});
}

}  // namespace

TEST_CASE("a unit that throws is named, with the time and its message") {
  const Workspace workspace = beside_a_filter("fuse", "thrower.fmu");
  CHECK_THAT(failure_of(workspace, {"--set", "fuse.throw_at=0.5"}, "0.499"),
             Contains(workspace.at("thrower.fmu") + "unit 'fuse', at 0.499 s: ") &&
                 Contains("fmi3Error") && Contains("the fuse has blown"));
}

TEST_CASE("the message of a unit that throws is there once") {
  const Workspace workspace = beside_a_filter("fuse", "thrower.fmu");
  const auto hosting = GENERATE(as<std::string>(), "--no-report", "--isolate");
  const Outcome outcome = workspace.run({"--set", "fuse.throw_at=0.5", hosting});
  CHECK(outcome.exit_code == 1);
  const std::size_t first = outcome.err.find("the fuse has blown");
  REQUIRE(first != std::string::npos);
  CHECK(outcome.err.find("the fuse has blown", first + 1) == std::string::npos);
}

TEST_CASE("a unit that throws something else is named, too") {
  const Workspace workspace = beside_a_filter("fuse", "thrower.fmu");
  CHECK_THAT(
      failure_of(workspace, {"--set", "fuse.throw_at=0.5", "--set", "fuse.odd=true"}, "0.499"),
      Contains("unit 'fuse', at 0.499 s: ") && Contains("not a std::exception"));
}

TEST_CASE("a unit that answers fmi3Error without a word") {
  const Workspace workspace = beside_a_filter("error", "raw");
  make_raw_fmu(workspace.scratch(), "raw");
  CHECK_THAT(failure_of(workspace, {}, "0"),
             Contains(workspace.at("source=\"raw\"") + "unit 'error', at 0 s: ") &&
                 Contains("fmi3DoStep returned fmi3Error"));
}

TEST_CASE("an output that is not a number is named, with the time") {
  const Workspace workspace =
      beside_a_filter("source", "not_a_number.fmu", connection("source.y", "filter.u"));
  CHECK_THAT(failure_of(workspace, {"--set", "source.nan_at=0.25"}, "0.249"),
             Contains("unit 'source', variable 'y', at 0.25 s: ") && Contains("NaN"));
}

TEST_CASE("a unit that rejects each step, however small") {
  const Workspace workspace = beside_a_filter("stepper", "stepper.fmu");
  CHECK_THAT(failure_of(workspace, {"--set", "stepper.largest_step=0"}, "0"),
             Contains("unit 'stepper', at 0 s: ") && Contains("rejected"));
}

TEST_CASE("a full disk is an error, whichever file it hits") {
  const Workspace workspace(two_filters());
  const std::string full = GENERATE(from_range(kFiles));
  fs::create_directory(workspace / "out");
  fs::create_symlink("/dev/full", workspace / "out" / full);
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: out/" + full) &&
                              Contains("No space left on device") && Contains("make room"));
  for (const std::string& file : kFiles) {
    if (file != full) CHECK_FALSE(workspace.result(file).empty());
  }
  if (full != "signals.csv") CHECK(last_time(workspace) == "1");
  if (full != "run.json") CHECK_THAT(run_json(workspace)["error"], Contains(full));
}

TEST_CASE("where all files fail, the first failure is reported") {
  const Workspace workspace(two_filters());
  fs::create_directory(workspace / "out");
  for (const std::string& file : kFiles) {
    fs::create_symlink("/dev/full", workspace / "out" / file);
  }
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: out/signals.csv: at 1 s: "));
}

TEST_CASE("the first signal ends a run whose unit never ends its step") {
  const Workspace workspace = beside_a_filter("sleeper", "fmi2_sleeper.fmu");
  const auto hosting = GENERATE(as<std::string>(), "--no-report", "--isolate");
  Process process(
      stride_command(Workspace::run_arguments({"--set", "sleeper.how=2", "--quiet", hosting})),
      workspace.scratch().path());
  using namespace std::chrono_literals;
  while (process.is_running() && !fs::exists(workspace / "out/signals.csv")) {
    std::this_thread::sleep_for(1ms);
  }
  std::this_thread::sleep_for(300ms);  // until it waits in its first step
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'sleeper', at 0 s: the run was interrupted"));
}

TEST_CASE("an interrupted run keeps what it has recorded") {
  const Workspace workspace(two_filters());
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(signal);
  const Outcome outcome = process.wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("the run was interrupted; its results up to there are complete"));
  CHECK_THAT(outcome.out, Contains(", interrupted\n") && Contains("Results in out"));
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "interrupted");
  CHECK_FALSE(run.contains("error"));
  const Csv signals = workspace.signals();  // throws for a row that is cut
  CHECK(signals.number(signals.size() - 1, 0) == run["reached"]);
  CHECK(signals.size() == run["communication_steps"].get<std::size_t>() + 1);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a second signal ends a run that reaches no communication point, with its rows on disk") {
  const Workspace workspace = beside_a_filter("faulty", "faulty.fmu");
  Process process(
      stride_command(Workspace::run_arguments({"--set", "faulty.fault=loop", "--set",
                                               "faulty.at=0.5", "--set", "faulty.file=looping"})),
      workspace.scratch().path());
  while (process.is_running() && !fs::exists(workspace / "looping")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  process.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(process.is_running());
  process.send(SIGINT);
  CHECK(process.wait().exit_code == -SIGINT);
  CHECK(last_time(workspace) == "0.499");
}

TEST_CASE("nothing is written into the results where standard streams are closed") {
  const Workspace workspace = beside_a_filter("fuse", "thrower.fmu");
  const std::string streams = GENERATE("<&-", ">&-", "2>&-", "<&- >&- 2>&-");
  INFO(streams);
  const std::string command = shell_command({"--progress", "plain", "--set", "fuse.throw_at=0.5"});
  const Outcome outcome =
      Process({"sh", "-c", "exec " + command + streams}, workspace.scratch().path()).wait();
  CHECK(outcome.exit_code == 1);
  CHECK(last_time(workspace) == "0.499");
  CHECK(workspace.result("signals.csv").find("stride") == std::string::npos);
  CHECK_THAT(run_json(workspace)["error"].get<std::string>(), Contains("the fuse has blown"));
}

TEST_CASE("a summary that cannot be printed is an error, after the run is complete") {
  const Workspace workspace(two_filters());
  const auto [target, code] =
      GENERATE(table<std::string, int>({{"> /dev/full", 1}, {"| true", 128 + SIGPIPE}}));
  INFO(target);
  const std::string command = shell_command({});
  const Outcome outcome =
      Process({"bash", "-c", "set -o pipefail; " + command + target}, workspace.scratch().path())
          .wait();
  CHECK(outcome.exit_code == code);
  if (code == 1) CHECK_THAT(outcome.err, Contains("No space left on device"));
  CHECK(run_json(workspace)["outcome"] == "completed");
  CHECK(last_time(workspace) == "1");
}

TEST_CASE("a second run into the folder of one that has not ended is refused") {
  const Workspace workspace(two_filters());
  Process first(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                workspace.scratch().path());
  await_first_results(first, workspace);
  const Outcome second = workspace.run({"--quiet"});
  CHECK(second.exit_code == 2);
  CHECK_THAT(second.err,
             Contains("out: process ") && Contains(" ('stride') has locked this folder"));
  CHECK(first.is_running());
  first.send(SIGINT);
  CHECK(first.wait().exit_code == 1);
  CHECK(run_json(workspace)["outcome"] == "interrupted");
  CHECK(workspace.run({"--quiet"}).exit_code == 0);
}

TEST_CASE("what a killed run leaves goes with the next one") {
  const Leftovers leftovers;
  const Workspace workspace(two_filters());
  {
    Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                    workspace.scratch().path());
    await_first_results(process, workspace);
    process.send(SIGKILL);
    CHECK(process.wait().exit_code == -SIGKILL);
  }
  CHECK(leftovers.after_a_while() == std::vector<std::string>{});
  CHECK_FALSE(workspace.left_behind().empty());
  CHECK(workspace.run({"--quiet"}).exit_code == 0);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("without a folder for temporary files, units cannot be unpacked") {
  const Workspace workspace(two_filters());
  ::setenv("TMPDIR", (workspace / "nowhere").c_str(), 1);  // Scratch resets it
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("TMPDIR: cannot") && Contains("nowhere/stride-") &&
                              Contains("set TMPDIR to a folder"));
}
