// Each way in which a unit may fail, in each call, for both versions of FMI, in the process of
// stride and in one of the unit's own: exit code 1, the unit, the function, the simulated time and
// the way, complete results up to there, and nothing left behind.
#include <array>
#include <csignal>
#include <utility>

#include "tests/build.h"
#include "tests/cli/failures.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kCompletes = "";

/// What the error contains; FUNCTION is the one that was called.
struct Fault {
  const char* name;        ///< of tests/test_units/faults
  const char* in_process;  ///< or kCompletes; null: this is not tried
  const char* hosted;      ///< likewise, in a process of the unit's own
};

/// In the step that ends at 0.5 s.
constexpr Fault kFaults[] = {
    {"segfault", "signal 11 (SIGSEGV) ends stride in FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"stack overflow", "signal 11 (SIGSEGV) ends stride in FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"abort", "signal 6 (SIGABRT) ends stride in FUNCTION",
     "its process was ended by signal 6 (SIGABRT) in FUNCTION"},
    {"throw in a thread", nullptr, "its process was ended by signal 6 (SIGABRT) in FUNCTION"},
    {"SIGFPE", "signal 8 (SIGFPE) ends stride in FUNCTION",
     "its process was ended by signal 8 (SIGFPE) in FUNCTION"},
    {"SIGILL", "signal 4 (SIGILL) ends stride in FUNCTION",
     "its process was ended by signal 4 (SIGILL) in FUNCTION"},
    {"SIGBUS", "signal 7 (SIGBUS) ends stride in FUNCTION",
     "its process was ended by signal 7 (SIGBUS) in FUNCTION"},
    {"SIGSYS", "signal 31 (SIGSYS) ends stride in FUNCTION",
     "its process was ended by signal 31 (SIGSYS) in FUNCTION"},
    {"SIGTERM", "signal 15 (SIGTERM) ends stride in FUNCTION",
     "its process was ended by signal 15 (SIGTERM) in FUNCTION"},
    {"SIGINT", "signal 2 (SIGINT) ends stride in FUNCTION",
     "its process was ended by signal 2 (SIGINT) in FUNCTION"},
    {"SIGUSR1", "signal 10 (SIGUSR1) ends stride in FUNCTION",
     "its process was ended by signal 10 (SIGUSR1) in FUNCTION"},
    {"SIGQUIT", "signal 3 (SIGQUIT) ends stride in FUNCTION",
     "its process was ended by signal 3 (SIGQUIT) in FUNCTION"},
    {"SIGPROF", "signal 27 (SIGPROF) ends stride in FUNCTION",
     "its process was ended by signal 27 (SIGPROF) in FUNCTION"},
    {"SIGXCPU", "signal 24 (SIGXCPU) ends stride in FUNCTION",
     "its process was ended by signal 24 (SIGXCPU) in FUNCTION"},
    {"SIGRTMIN+3", "(SIGRTMIN+3) ends stride in FUNCTION", "(SIGRTMIN+3) in FUNCTION"},
    {"hidden signal", "signal 33 (SIGRTMIN-1) ends stride in FUNCTION",
     "its process was ended by signal 33 (SIGRTMIN-1) in FUNCTION"},
    {"kill", "signal 9 (SIGKILL) ends stride during FUNCTION",
     "its process was ended by signal 9 (SIGKILL) in FUNCTION"},
    {"exit with 0", "exit() ends stride in FUNCTION",
     "it ended its process with exit code 0 in FUNCTION"},
    {"exit", "exit() ends stride in FUNCTION", "it ended its process with exit code 3 in FUNCTION"},
    {"_exit", "an exit with code 4 ends stride during FUNCTION",
     "it ended its process with exit code 4 in FUNCTION"},
    {"exit in a thread", nullptr, "it ended its process with exit code 5 in FUNCTION"},
    {"exit by system call", "an exit with code 0 ends stride during FUNCTION",
     "it ended its process with exit code 0 in FUNCTION"},
    {"exit of a looked-up name", "an exit with code 0 ends stride during FUNCTION",
     "it ended its process with exit code 0 in FUNCTION"},
    {"default signal", "signal 11 (SIGSEGV) ends stride during FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"unmap shared memory", "signal 11 (SIGSEGV) ends stride during FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"protect shared memory", "signal 11 (SIGSEGV) ends stride during FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"exec", "the program '/usr/bin/sleep' has replaced stride during FUNCTION", nullptr},
    {"exec by system call", " stride during FUNCTION",
     "it ended its process with exit code 0 in FUNCTION"},
    {"become daemon", "an exit with code 0 ends stride during FUNCTION",
     "it ended its process with exit code 0 in FUNCTION"},
    {"close streams and crash", "signal 11 (SIGSEGV) ends stride in FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"divert errors and crash", "signal 11 (SIGSEGV) ends stride in FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"be traced and crash", "signal 11 (SIGSEGV) ends stride in FUNCTION",
     "its process was ended by signal 11 (SIGSEGV) in FUNCTION"},
    {"run programs", kCompletes, kCompletes},
    {"throw int", "FUNCTION threw something that is not a std::exception",
     "FUNCTION threw something that is not a std::exception"},
    {"throw bad_alloc", "FUNCTION threw std::bad_alloc", "FUNCTION threw std::bad_alloc"},
    {"throw exception", "FUNCTION threw the fuse has blown", "FUNCTION threw the fuse has blown"},
    {"status 77", "FUNCTION returned 77, a status that", "FUNCTION returned 77, a status that"},
    {"limit parent", nullptr, "cannot limit the parent: Permission denied"},
    {"close streams", kCompletes, kCompletes},
    {"buffer output", kCompletes, kCompletes},
    {"drop output stream", kCompletes, nullptr},
    {"close files", nullptr, kCompletes},
    {"change folder", kCompletes, kCompletes},
    {"change umask", kCompletes, kCompletes},
    {"block signals", kCompletes, kCompletes},
    {"ignore SIGINT", kCompletes, kCompletes},
    {"limit resources", nullptr, kCompletes},
    {"limit open files", kCompletes, kCompletes},
    {"fork", kCompletes, kCompletes},
    {"fork and go on", kCompletes, kCompletes},
    {"round up", kCompletes, kCompletes},
    {"flush to zero", kCompletes, kCompletes},
    {"set direction flag", kCompletes, kCompletes},
    {"cancel thread", kCompletes, kCompletes},
};

struct Call {
  const char* name;                       ///< as a fault unit knows it
  const char* at;                         ///< the first end of a step at which it fails [s]
  std::array<const char*, 2> functions;   ///< of FMI 2.0, which may have none such, and 3.0
  const char* last;                       ///< row of the results; null: there are no results
  const char* neighbour = "minimal.fmu";  ///< which lets it be called
};

constexpr Call kStep{"step", "0.5", {"fmi2DoStep", "fmi3DoStep"}, "0.375"};
constexpr Call kInstantiate{
    "instantiate", "0", {"fmi2Instantiate", "fmi3InstantiateCoSimulation"}, nullptr};
constexpr Call kFree{"free", "0", {"fmi2FreeInstance", "fmi3FreeInstance"}, "1"};
/// The other ones.
constexpr Call kCalls[] = {
    {"initialize", "0", {"fmi2ExitInitializationMode", "fmi3ExitInitializationMode"}, nullptr},
    {"event", "0", {nullptr, "fmi3UpdateDiscreteStates"}, nullptr},
    {"get", "0.5", {"fmi2GetReal", "fmi3GetFloat64"}, "0.375"},
    {"set", "0.5", {"fmi2SetReal", "fmi3SetFloat64"}, "0.5"},
    {"get state", "0.5", {"fmi2GetFMUstate", "fmi3GetFMUState"}, "0.5", "early.fmu"},
    {"terminate", "0", {"fmi2Terminate", "fmi3Terminate"}, "1"},
};

/// How the unit is used. AddressSanitizer has handlers of its own in the process of stride.
struct Setting {
  int version;
  bool is_hosted;

  std::string unit() const { return "fmi" + std::to_string(version) + "_faulty.fmu"; }
  const char* function(const Call& call) const { return call.functions[version - 2]; }
  const char* end(const Fault& fault) const { return is_hosted ? fault.hosted : fault.in_process; }
};

std::vector<Setting> settings() {
  std::vector<Setting> all{{2, true}, {3, true}};
  if (!kSanitized) all.insert(all.end(), {{2, false}, {3, false}});
  return all;
}

Workspace workspace_for(const Setting& setting, const Call& call) {
  return Workspace(Parts{component("first", call.neighbour) + component("faulty", setting.unit()),
                         connection("first.y", "faulty.u")});
}

/// A run whose unit commits the fault; nothing is left of it.
Outcome run(const Workspace& workspace, const Setting& setting, const char* fault,
            const Call& call) {
  const Leftovers leftovers;
  const FaultOrder order(fault, call.name, call.at);
  Arguments arguments{"--quiet", "--step", "0.125", "--junit", (workspace / "junit.xml").string()};
  if (setting.is_hosted) arguments.push_back("--isolate");
  const Outcome outcome = workspace.run(arguments);
  CHECK(leftovers.all() == std::vector<std::string>{});
  CHECK(workspace.left_behind().empty());
  return outcome;
}

std::string with_function(std::string text, const std::string& function) {
  const std::string kWord = "FUNCTION";
  const std::size_t at = text.find(kWord);
  return at == std::string::npos ? text : text.replace(at, kWord.size(), function);
}

/// The error is on the standard error stream and in the report for tests.
void check_error(const Workspace& workspace, const Outcome& outcome, const std::string& end) {
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out == "");
  CHECK_THAT(outcome.err, Contains("stride: error: " + workspace.at("_faulty.fmu")) &&
                              Contains("unit 'faulty'") && Contains(end));
  CHECK_THAT(read(workspace / "junit.xml"),
             Contains("unit &apos;faulty&apos;") || Contains("unit 'faulty'"));
}

/// Likewise in run.json, and all rows up to there are in the results.
void check_results(const Workspace& workspace, const Outcome& outcome, const char* last) {
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  CHECK_THAT(outcome.err, Contains("stride: error: " + run["error"].get<std::string>()));
  if (last != nullptr) CHECK(last_time(workspace) == last);
}

void check_completed(const Workspace& workspace, const Outcome& outcome) {
  CHECK(outcome.exit_code == 0);
  CHECK(last_time(workspace) == "1");
  CHECK(run_json(workspace)["outcome"] == "completed");
}

/// A crash, and an answer that means nothing.
constexpr Fault kCrash = kFaults[0];
constexpr Fault kStatus{"status 77", "FUNCTION returned 77, a status that",
                        "FUNCTION returned 77, a status that"};

}  // namespace

TEST_CASE("a unit that fails in a step is named, with the function, the time and the way") {
  for (const Setting& setting : settings()) {
    const Workspace workspace = workspace_for(setting, kStep);
    for (const Fault& fault : kFaults) {
      INFO("FMI " << setting.version << (setting.is_hosted ? ", hosted: " : ": ") << fault.name);
      if (setting.end(fault) == nullptr) continue;
      const Outcome outcome = run(workspace, setting, fault.name, kStep);
      INFO(outcome.err);
      const std::string end = with_function(setting.end(fault), setting.function(kStep));
      if (end == kCompletes) {
        check_completed(workspace, outcome);
        continue;
      }
      check_error(workspace, outcome, "unit 'faulty', at 0.375 s: ");
      check_error(workspace, outcome, end);
      check_results(workspace, outcome, kStep.last);
      CHECK(fs::exists(workspace / "out/report.html"));
      if (end.find("ends stride") != end.npos)
        CHECK_THAT(outcome.err, Contains("--isolate=faulty"));
    }
  }
}

TEST_CASE("a status that the unit's version of FMI does not have is an error with its number") {
  for (const Setting& setting : settings()) {
    if (setting.version == 2) continue;  // where 5 is fmi2Pending
    const Workspace workspace = workspace_for(setting, kStep);
    const Outcome outcome = run(workspace, setting, "status 5", kStep);
    check_error(workspace, outcome, "fmi3DoStep returned 5, a status that FMI 3.0 does not have");
    check_results(workspace, outcome, kStep.last);
  }
}

TEST_CASE("a unit that fails in another call") {
  for (const Setting& setting : settings()) {
    for (const Call& call : kCalls) {
      if (setting.function(call) == nullptr) continue;
      const Workspace workspace = workspace_for(setting, call);
      for (const Fault& fault : {kCrash, kStatus}) {
        INFO("FMI " << setting.version << (setting.is_hosted ? ", hosted: " : ": ") << fault.name
                    << " in " << call.name);
        const Outcome outcome = run(workspace, setting, fault.name, call);
        INFO(outcome.err);
        check_error(workspace, outcome, with_function(setting.end(fault), setting.function(call)));
        check_results(workspace, outcome, call.last);
      }
    }
  }
}

TEST_CASE("a unit that crashes when it is made has no results") {
  for (const Setting& setting : settings()) {
    INFO("FMI " << setting.version << (setting.is_hosted ? ", hosted" : ""));
    const Workspace workspace = workspace_for(setting, kInstantiate);
    const Outcome outcome = run(workspace, setting, kCrash.name, kInstantiate);
    check_error(workspace, outcome,
                with_function(setting.end(kCrash), setting.function(kInstantiate)));
  }
}

TEST_CASE("a unit that crashes at its end has all results") {
  for (const Setting& setting : settings()) {
    INFO("FMI " << setting.version << (setting.is_hosted ? ", hosted" : ""));
    const Workspace workspace = workspace_for(setting, kFree);
    const Outcome outcome = run(workspace, setting, kCrash.name, kFree);
    check_error(workspace, outcome, with_function(setting.end(kCrash), setting.function(kFree)));
    CHECK(last_time(workspace) == kFree.last);
  }
}

TEST_CASE("a function that forks and returns in both processes is of one run only") {
  for (const Setting& setting : settings()) {
    INFO("FMI " << setting.version << (setting.is_hosted ? ", hosted" : ""));
    const Workspace workspace = workspace_for(setting, kStep);
    REQUIRE(workspace.run({"--quiet", "--step", "0.125"}).exit_code == 0);
    const std::string expected = workspace.result("signals.csv");
    const char* const fault = GENERATE("fork", "fork by system call");
    const FaultOrder order(fault, kStep.name, kStep.at);
    Arguments arguments{"--verbose"};
    for (const std::string& argument : Workspace::run_arguments({"--quiet", "--step", "0.125"})) {
      arguments.push_back(argument);
    }
    if (setting.is_hosted) arguments.push_back("--isolate");
    const Outcome outcome = workspace.stride(arguments);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("unit 'faulty': " + std::string(setting.function(kStep)) +
                                     " called fork() and returned in both processes"));
    CHECK(workspace.result("signals.csv") == expected);
  }
}

TEST_CASE("a signal of a timer is no interruption by the user, and no unit's for certain") {
  if (kSanitized) return;
  const Setting setting{3, false};
  const Workspace workspace = workspace_for(setting, kStep);
  const Outcome outcome = run(workspace, setting, "alarm", kStep);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: signal 14 (SIGALRM) ends stride during "
                                   "fmi3DoStep of 'faulty'"));
  check_results(workspace, outcome, kStep.last);
}

TEST_CASE("a unit's own timer may run on when the unit is gone") {
  if (kSanitized) return;
  const Setting setting{3, false};
  const Workspace workspace = workspace_for(setting, kStep);
  const Outcome outcome = run(workspace, setting, "own alarms", kStep);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, !Contains("error"));
}

TEST_CASE("a signal from outside that ends the run is reported, and ends the process") {
  if (kSanitized) return;
  const auto [signal, name] = GENERATE(table<int, std::string>(
      {{SIGQUIT, "SIGQUIT"}, {SIGPROF, "SIGPROF"}, {SIGABRT, "SIGABRT"}, {SIGSEGV, "SIGSEGV"}}));
  const Workspace workspace = workspace_for({3, false}, kStep);
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(signal);
  const Outcome outcome = process.wait();
  CHECK(outcome.exit_code == -signal);
  CHECK_THAT(outcome.err, Contains("(" + name + ") from outside ends stride"));
  CHECK(outcome.err.find("hint") == std::string::npos);
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  const double last = std::stod(last_time(workspace));  // the next row may have been begun
  CHECK(run["reached"].get<double>() == Approx(last).margin(0.0011));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("SIGUSR1 from outside interrupts the run") {
  const Workspace workspace = workspace_for({3, false}, kStep);
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(SIGUSR1);
  CHECK(process.wait().exit_code == 1);
  CHECK(run_json(workspace)["outcome"] == "interrupted");
}

TEST_CASE("a unit that has damaged the memory of stride does not end it without a word") {
  if (kSanitized) return;
  const Setting setting = GENERATE(Setting{2, false}, Setting{3, false});
  const Workspace workspace = workspace_for(setting, kStep);
  for (const auto& [fault, signal] :
       {std::pair("damage free memory", "6 (SIGABRT)"), {"lock memory", "11 (SIGSEGV)"}}) {
    INFO(fault);
    const Outcome outcome = run(workspace, setting, fault, kStep);
    INFO(outcome.err);
    check_error(workspace, outcome, "unit 'faulty', at 0.375 s: ");
    check_error(workspace, outcome, std::string("signal ") + signal + " ends stride");
    check_results(workspace, outcome, kStep.last);
    CHECK(run_json(workspace)["reached"] == 0.375);
  }
}

TEST_CASE("a unit that has overwritten what stride notes of it does not end it without a word") {
  if (kSanitized) return;
  const Workspace workspace = workspace_for({3, false}, kStep);
  const Outcome outcome = run(workspace, {3, false}, "overwrite and die", kStep);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  const std::string error =
      "signal 9 (SIGKILL) ends stride, after other code had overwritten what stride notes of its "
      "calls";
  CHECK_THAT(outcome.err, Contains("stride: error: " + error + "\n"));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK_THAT(run_json(workspace)["error"].get<std::string>(), Contains(error));
  CHECK_THAT(read(workspace / "junit.xml"), Contains(error));
}

TEST_CASE("a run.json that a unit has damaged or removed hides no error, and is no riddle") {
  if (kSanitized) return;
  const auto [fault, reason] = GENERATE(table<const char*, std::string>(
      {{"write over run file and die", "other code has written to this file"},
       {"remove run file and die", "other code has removed or replaced this file"}}));
  const Workspace workspace = workspace_for({3, false}, kStep);
  const Outcome outcome = run(workspace, {3, false}, fault, kStep);
  check_error(workspace, outcome, "signal 9 (SIGKILL) ends stride during fmi3DoStep");
  CHECK_THAT(outcome.err, Contains("out/run.json: " + reason));
  CHECK(last_time(workspace) == kStep.last);
}

TEST_CASE("a unit that leaves no room for the results is an error in the records of the run") {
  if (kSanitized) return;
  const Workspace workspace = workspace_for({3, false}, kStep);
  const Outcome outcome = run(workspace, {3, false}, "limit files by system call", kStep);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("signals.csv: at 1 s: cannot write the file: File too large"));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK_THAT(read(workspace / "junit.xml"), Contains("<error message="));
}

TEST_CASE("a unit that leaves no memory for the report is an error that says so") {
  if (kSanitized) return;
  const Workspace workspace = workspace_for({3, false}, kStep);
  const Outcome outcome = run(workspace, {3, false}, "limit memory by system call", kStep);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: there is not enough memory"));
  CHECK(last_time(workspace) == "1");
}

TEST_CASE("a unit whose state may not be saved is never asked for it") {
  const std::string components =
      component("first", "early.fmu") + component("faulty", "fmi2_faulty.fmu");
  const std::string wire = connection("first.y", "faulty.u");
  const FaultOrder order("segfault", "get state", "0");
  const Workspace saving(Parts{components, wire});
  CHECK(saving.run({"--quiet", "--step", "0.125"}).exit_code == 1);
  const Workspace forbidden(
      Parts{components, wire, "<stride:StateSaving components=\"faulty\" allowed=\"false\"/>"});
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments options{"--quiet", "--step", "0.125"};
  options.insert(options.end(), hosting.begin(), hosting.end());
  const Outcome outcome = forbidden.run(options);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a run that is killed with what watches it is not taken for one that has ended") {
  const Leftovers leftovers;
  const Workspace workspace = workspace_for({3, false}, kStep);
  REQUIRE(workspace.run({"--quiet", "--step", "0.125"}).exit_code == 0);
  REQUIRE(run_json(workspace)["outcome"] == "completed");
  fs::remove(workspace / "out/signals.csv");
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  CHECK(run_json(workspace)["outcome"] == "running");
  process.send(SIGKILL);
  CHECK(process.wait().exit_code == -SIGKILL);
  CHECK(leftovers.after_a_while() == std::vector<std::string>{});
  CHECK(run_json(workspace)["outcome"] == "running");
  CHECK_FALSE(fs::exists(workspace / "out/report.html"));
}

TEST_CASE("a thread that a unit has started is not taken for the unit whose function is called") {
  if (kSanitized) return;
  const Setting setting{3, false};
  const Workspace workspace = workspace_for(setting, kStep);
  for (const char* fault : {"throw in a thread", "exit in a thread"}) {
    INFO(fault);
    const Outcome outcome = run(workspace, setting, fault, kStep);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains(" ends stride in a thread that a unit has started, during "
                                     "fmi3DoStep of 'faulty'"));
    check_results(workspace, outcome, kStep.last);
  }
}

TEST_CASE("a unit cannot end other commands with the exit code 0, or without a word") {
  if (kSanitized) return;
  const Setting setting = GENERATE(Setting{2, false}, Setting{3, false});
  const Workspace workspace = workspace_for(setting, kInstantiate);
  for (const char* fault : {"exit with 0", "_exit", "segfault"}) {
    INFO("FMI " << setting.version << ": " << fault);
    const FaultOrder order(fault, kInstantiate.name, kInstantiate.at);
    const Outcome outcome = workspace.stride({"check", "test.ssd"});
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("unit 'faulty'") && Contains(" ends stride ") &&
                                Contains(setting.function(kInstantiate)));
  }
}

TEST_CASE("a unit that opens all files that it can leaves some for the results") {
  const std::string hosting = GENERATE("", " '--isolate'");
  const Workspace workspace = workspace_for({3, false}, kStep);
  for (const char* fault : {"open all files", "open all files and crash"}) {
    INFO(fault << hosting);
    if (kSanitized && hosting.empty()) continue;
    const bool crashes = std::string(fault) != "open all files";
    const FaultOrder order(fault, kStep.name, kStep.at);
    const std::string command = shell_command({"--quiet", "--step", "0.125"}) + hosting;
    const Outcome outcome =
        Process({"sh", "-c", "ulimit -n 128; exec " + command}, workspace.scratch().path()).wait();
    INFO(outcome.err);
    CHECK(outcome.exit_code == (crashes ? 1 : 0));
    CHECK(run_json(workspace)["outcome"] == (crashes ? "failed" : "completed"));
    CHECK(last_time(workspace) == (crashes ? kStep.last : "1"));
    CHECK(fs::exists(workspace / "out/report.html"));
    CHECK(workspace.left_behind().empty());
  }
}

TEST_CASE("units have hosts where whoever has started stride ignores the end of processes") {
  const Workspace workspace = workspace_for({3, true}, kStep);
  const std::string command = shell_command({"--quiet", "--step", "0.125", "--isolate"});
  const Outcome outcome =
      Process({"sh", "-c", "trap '' CHLD; exec " + command}, workspace.scratch().path()).wait();
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a hosted unit has no terminal") {
  const auto [hosting, code] = GENERATE(table<std::string, int>({{"", 0}, {" '--isolate'", 1}}));
  const Workspace workspace = workspace_for({3, false}, kStep);
  const FaultOrder order("use terminal", kStep.name, kStep.at);
  const Outcome outcome =
      Process({"script", "-qec", shell_command({"--step", "0.125"}) + hosting, "/dev/null"},
              workspace.scratch().path())
          .wait();
  INFO(outcome.out);
  CHECK(outcome.exit_code == code);
  if (code == 1) CHECK_THAT(outcome.out, Contains("there is no terminal: "));
}
