// Units in the process of stride that end it: exit code 1, who did it, when and how, and complete
// results up to there.
#include <csignal>

#include "tests/build.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

Workspace beside_a_filter(const std::string& source) {
  return Workspace(Parts{component("filter", "minimal.fmu") + component("faulty", source)});
}

struct Fault {
  const char* name;    ///< of the unit of FMI 3.0
  const char* number;  ///< of that of FMI 2.0; null: it has none such
  const char* end;
};

const std::vector<Fault> kFaults{
    {"segfault", "1", "signal 11 (SIGSEGV) ends stride in "},
    {"abort", "2", "signal 6 (SIGABRT) ends stride in "},
    {"exit with 0", "3", "exit() ends stride in "},
    {"stack overflow", "4", "signal 11 (SIGSEGV) ends stride in "},
    {"exit", nullptr, "exit() ends stride in "},
    {"_exit", nullptr, "exit() ends stride in "},
    {"exit in a thread", nullptr, "exit() ends stride in "},
    {"throw in a thread", nullptr, "signal 6 (SIGABRT) ends stride in "},
};

}  // namespace

TEST_CASE("a unit that ends the process of stride is named, with the call, the time and the way") {
  if (kSanitized) return;  // AddressSanitizer has handlers of its own
  const auto version = GENERATE(2, 3);
  const Workspace workspace = beside_a_filter(version == 3 ? "faulty.fmu" : "fmi2_faulty.fmu");
  for (const Fault& fault : kFaults) {
    INFO("FMI " << version << ": " << fault.name);
    if (version == 2 && fault.number == nullptr) continue;
    const std::string value = version == 3 ? fault.name : fault.number;
    Arguments options{"--set", "faulty.fault=" + value};
    if (version == 3) options.insert(options.end(), {"--set", "faulty.at=0.5"});
    options.insert(options.end(), {"--junit", (workspace / "report.xml").string()});
    const std::string error = failure_of(workspace, options, "0.499");
    const std::string function = version == 3 ? "fmi3DoStep" : "fmi2DoStep";
    CHECK_THAT(error, Contains("unit 'faulty', at 0.499 s: " + (fault.end + function)) &&
                          Contains("--isolate=faulty"));
    CHECK_THAT(read(workspace / "report.xml"), Contains(fault.end + function));
    CHECK(fs::exists(workspace / "out/report.html"));
  }
}

TEST_CASE("a unit that ends the process in another call") {
  if (kSanitized) return;
  const Workspace workspace = beside_a_filter("faulty.fmu");
  const auto [call, function] = GENERATE(table<std::string, std::string>({
      {"initialize", "fmi3ExitInitializationMode"},
      {"event", "fmi3UpdateDiscreteStates"},
      {"terminate", "fmi3Terminate"},
      {"free", "fmi3FreeInstance"},
  }));
  const Outcome outcome =
      workspace.run({"--quiet", "--set", "faulty.fault=segfault", "--set", "faulty.call=" + call});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'faulty'") && Contains("SIGSEGV") && Contains(function));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a unit that ends the process when it is made") {
  const Workspace workspace(Parts{component("dies_at_birth", "faulty.fmu")});
  const Outcome outcome =
      workspace.run({"--quiet", "--junit", (workspace / "report.xml").string()});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'dies_at_birth'") &&
                              Contains("signal 6 (SIGABRT) ends stride in fmi3Instantiate"));
  CHECK_THAT(read(workspace / "report.xml"), Contains("dies_at_birth"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("an exception that leaves a unit's function names the unit") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("throws", "raw_throwing")});
  make_raw_fmu(workspace.scratch(), "raw_throwing");
  CHECK_THAT(failure_of(workspace, {}, "0"),
             Contains("unit 'throws', at 0 s: fmi3DoStep threw thrown across the C interface"));
}

TEST_CASE("a unit that ends the process when it is freed is an error of a run with all its rows") {
  if (kSanitized) return;
  const Workspace workspace = beside_a_filter("faulty.fmu");
  for (const char* fault : {"abort", "exit with 0", "_exit"}) {
    INFO(fault);
    const std::string error = failure_of(
        workspace, {"--set", std::string("faulty.fault=") + fault, "--set", "faulty.call=free"},
        "1");
    CHECK_THAT(error,
               Contains("unit 'faulty', at 1 s: ") && Contains("ends stride in fmi3FreeInstance"));
  }
}

TEST_CASE("a library that ends the process when it is unloaded, or after the run, is an error") {
  if (kSanitized) return;
  const Workspace workspace = beside_a_filter("faulty.fmu");
  const auto [call, place] = GENERATE(table<std::string, std::string>({
      {"unload", " in the unloading of '"},
      {"exit", " in a destructor or an exit function of a library, after the command"},
  }));
  const auto [fault, end] = GENERATE(table<std::string, std::string>({
      {"abort", "signal 6 (SIGABRT) ends stride"},
      {"segfault", "signal 11 (SIGSEGV) ends stride"},
      {"_exit", "exit() ends stride"},
  }));
  const Outcome outcome =
      workspace.run({"--quiet", "--set", "faulty.fault=" + fault, "--set", "faulty.call=" + call});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: " + end + place));
  CHECK(last_time(workspace) == "1");
  CHECK(workspace.left_behind().empty());
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
