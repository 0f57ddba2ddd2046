// Libraries of units that end the process, or do not return, when they are unloaded or after the
// run: exit code 1, the rows of a complete run, and nothing left behind.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>

#include <elf.h>
#include <link.h>

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
      {"_exit", "an exit with code 4 ends stride"},
  }));
  const Outcome outcome = workspace.run(library_does(fault, call, {"--junit", "junit.xml"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains(end + place));
  if (call == "unload") CHECK_THAT(outcome.err, Contains("unit 'faulty': " + end));
  CHECK(last_time(workspace) == "1");
  CHECK(workspace.left_behind().empty());
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

TEST_CASE("a hosted unit's exit function that ends the process is an error") {
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const Leftovers leftovers;
  const auto [fault, end] = GENERATE(table<const char*, std::string>({
      {"crash at exit", "its process was ended by signal 11 (SIGSEGV)"},
      {"exit at exit", "it ended its process with exit code 0"},
  }));
  const FaultOrder order(fault, "step", "0.5");
  const Outcome outcome = workspace.run({"--quiet", "--step", "0.125", "--isolate"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("unit 'faulty', at 1 s: " + end + " in an exit function of its library"));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK(last_time(workspace) == "1");
  CHECK(leftovers.all() == std::vector<std::string>{});
}

TEST_CASE("'stride check' fails where the process of a unit does not end well") {
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const std::string call = GENERATE("free", "unload");
  const FaultOrder order("segfault", call.c_str(), "0");
  const Outcome outcome = workspace.stride({"check", "test.ssd", "--isolate"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("Step order"));
  CHECK_THAT(outcome.err, Contains("stride: error: test.ssd") && Contains("unit 'faulty'") &&
                              Contains("ended by signal 11 (SIGSEGV)"));
}

TEST_CASE("'stride verify' fails where an exit function of the unit ends the process") {
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const auto [fault, end] = GENERATE(table<const char*, std::string>(
      {{"crash at exit", "SIGSEGV"}, {"exit at exit", "exit code 1"}}));
  const FaultOrder order(fault, "step", "0");
  const Outcome outcome = workspace.stride({"verify", test_fmu("fmi3_faulty").string()});
  INFO(outcome.out);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains(end));
}

TEST_CASE("an exit function that calls exit(0) is an error") {
  if (kSanitized) return;
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const FaultOrder order("exit at exit", "step", "0.5");
  const Outcome outcome = workspace.run({"--quiet", "--step", "0.125"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("exit() ends stride in a destructor or an exit function of a "
                                   "library, after the command"));
  CHECK(last_time(workspace) == "1");
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
    CHECK_THAT(outcome.err, Contains("stride has not ended for 10 s in "));
  }
  for (const char* folder : {"unload", "exit"}) {
    const Csv signals(workspace / (std::string(folder) + "/signals.csv"));
    CHECK(signals.row(signals.size() - 1).front() == "1");
  }
  CHECK_THAT(read(workspace / "unload/run.json"), Contains("\"outcome\": \"failed\""));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a thread that keeps the lock of a standard stream does not hold up the end") {
  if (kSanitized) return;
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const auto start = [&](const char* fault, const char* folder, const Arguments& further = {}) {
    const FaultOrder order(fault, "step", "0.5");
    Arguments all{"run", "test.ssd", "--step", "0.125", "--out", folder};
    all.insert(all.end(), further.begin(), further.end());
    return Process(stride_command(all), workspace.scratch().path());
  };
  Process output = start("keep lock of output", "output");  // each takes 10 s
  Process errors = start("keep lock of errors", "errors");
  Process quiet = start("keep lock of output", "quiet", {"--quiet"});
  for (Process* process : {&output, &errors, &quiet}) {
    const Outcome outcome = process->wait();
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("unit 'faulty': stride has not ended for 10 s, since a thread "
                                     "that it has started keeps the lock of the standard output"));
  }
  for (const char* const folder : {"output", "errors", "quiet"}) {
    const Csv signals(workspace / (std::string(folder) + "/signals.csv"));
    CHECK(signals.row(signals.size() - 1).front() == "1");
    CHECK_THAT(read(workspace / (std::string(folder) + "/run.json")),
               Contains("\"outcome\": \"failed\""));
  }
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a library that does not return when it is unloaded is cut off in other commands, too") {
  if (kSanitized) return;
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const FaultOrder order("sleep", "unload", "0");
  const Outcome outcome = workspace.stride({"check", "test.ssd"});  // takes 10 s
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("unit 'faulty': stride has not ended for 10 s in the unloading of '"));
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

TEST_CASE("a library that calls exit(0) after the run is an error, and hides no earlier one") {
  const Workspace workspace(
      Parts{component("faulty", "faulty.fmu") + component("fuse", "thrower.fmu")});
  const Arguments options{"--quiet", "--set", "faulty.fault=exit with 0", "--set",
                          "faulty.call=exit"};
  const auto run = [&](const std::string& throw_at) {
    Arguments arguments = options;
    arguments.insert(arguments.end(), {"--set", "fuse.throw_at=" + throw_at});
    return workspace.run(arguments);
  };
  const Outcome alone = run("10");
  CHECK(alone.exit_code == 1);
  CHECK_THAT(alone.err, Contains("exit() ends stride in a destructor or an exit function of a "
                                 "library, after the command"));
  CHECK_THAT(run_json(workspace)["error"].get<std::string>(), Contains("exit() ends stride"));
  const Outcome outcome = run("0.5");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the fuse has blown"));
}

TEST_CASE("a library that ends the process by a system call after the run leaves no good code") {
  if (kSanitized) return;
  const Workspace workspace(Parts{component("faulty", "fmi3_faulty.fmu")});
  const FaultOrder order("exit by system call at exit", "step", "0");
  const auto error_with = [&](Arguments options) {
    options.insert(options.end(), {"--quiet", "--step", "0.125"});
    const Outcome outcome = workspace.run(options);
    CHECK(outcome.exit_code == 1);
    return outcome.err;
  };
  CHECK_THAT(error_with({}), Contains("an exit with code 0 ends stride in a destructor or an exit "
                                      "function of a library, after the command"));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK_THAT(error_with({"--junit", "/dev/full"}), Contains("/dev/full: cannot write the file"));
}

// ---- What goes on when a library is unloaded ----

namespace {

/// With the function of the fault unit's in which it is left behind, and at its last instance.
Outcome run_that_leaves(const Workspace& workspace, const char* fault, const char* call,
                        Arguments further = {}) {
  const FaultOrder order(fault, call, "0");
  further.insert(further.end(), {"--quiet", "--step", "0.125"});
  return workspace.run(further);
}

Workspace with_fault_unit(const std::string& version) {
  return Workspace(Parts{component("filter", "minimal.fmu") +
                         component("faulty", "fmi" + version + "_faulty.fmu")});
}

}  // namespace

TEST_CASE("a library whose threads go on is not unloaded, with a warning that names the unit") {
  const Workspace workspace = with_fault_unit(GENERATE("2", "3"));
  const char* const fault = GENERATE("leave thread", "leave deaf thread");
  const char* const call = GENERATE("instantiate", "step", "free");
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  INFO(fault << " in " << call << (hosting.empty() ? "" : ", hosted"));
  const Outcome outcome = run_that_leaves(workspace, fault, call, hosting);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: unit 'faulty': its library stays loaded") &&
                              Contains("1 thread ('"));
  CHECK(run_json(workspace)["outcome"] == "completed");
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("threads that end by themselves when their unit is freed are no matter") {
  const Workspace workspace = with_fault_unit("3");
  const Outcome outcome = run_that_leaves(workspace, "leave short thread", "free");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("stays loaded") == std::string::npos);
}

TEST_CASE("a library whose function handles a signal is not unloaded") {
  const Workspace workspace = with_fault_unit("3");
  const Outcome outcome = run_that_leaves(workspace, "leave handler", "step");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("unit 'faulty': its library stays loaded") && Contains("handler of SIGPROF"));
}

TEST_CASE("what a unit registers with on_exit() is called at the end of the process") {
  const Workspace workspace = with_fault_unit(GENERATE("2", "3"));
  const Outcome outcome = run_that_leaves(workspace, "on_exit", "step");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("the function of on_exit() runs"));
  CHECK(run_json(workspace)["outcome"] == "completed");
}

TEST_CASE("a library whose objects another one keeps is not unloaded, and all ends quietly") {
  const Workspace workspace(Parts{component("registrar", "registrar.fmu")});
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  const Outcome outcome = workspace.run(hosting);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, !Contains("signal") && !Contains("stays loaded"));
  CHECK(run_json(workspace)["outcome"] == "completed");
}

TEST_CASE("a library whose objects another one keeps is packed and verified") {
  const Workspace workspace(Parts{component("registrar", "registrar.fmu")});
  const fs::path registry = unit_library("registrar").parent_path() / "libstride_test_registry.so";
  const auto arguments =
      GENERATE_COPY(Arguments{"pack", unit_library("registrar").string(), "--bundle",
                              registry.string(), "--output", "packed.fmu"},
                    Arguments{"verify", test_fmu("registrar").string()},
                    Arguments{"inspect", test_fmu("registrar").string()});
  const Outcome outcome = workspace.stride(arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
}

// ---- Damaged files ----

namespace {

/// The library of the unit `raw`, changed.
void change_library(const Workspace& workspace, const std::function<void(std::string&)>& change) {
  const fs::path folder = make_raw_fmu(workspace.scratch(), "raw");
  const fs::path library = folder / "binaries" / stride::importer::platform() / "raw.so";
  std::string bytes = read(library);
  change(bytes);
  std::ofstream(library, std::ios::binary | std::ios::trunc) << bytes;
}

/// The size in the file of the segment with the code becomes 13 MiB, as by one changed byte.
void enlarge_code(std::string& bytes) {
  ElfW(Ehdr) header;
  std::memcpy(&header, bytes.data(), sizeof header);
  for (int i = 0; i < header.e_phnum; ++i) {
    char* const place = bytes.data() + header.e_phoff + i * sizeof(ElfW(Phdr));
    ElfW(Phdr) segment;
    std::memcpy(&segment, place, sizeof segment);
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0) continue;
    segment.p_filesz += 0xd50000;
    std::memcpy(place, &segment, sizeof segment);
  }
}

}  // namespace

TEST_CASE("a damaged library is an error that names the component and the unit, for each command") {
  const Workspace workspace(Parts{component("motor", "raw")});
  const auto change = GENERATE(std::function<void(std::string&)>(enlarge_code),
                               [](std::string& bytes) { bytes.resize(bytes.size() / 4); });
  change_library(workspace, change);
  const Arguments arguments = GENERATE(Arguments{"run", "test.ssd", "--out", "out"},
                                       Arguments{"run", "test.ssd", "--out", "out", "--isolate"},
                                       Arguments{"check", "test.ssd"});
  const Outcome outcome = workspace.stride(arguments);
  CHECK(input_error_of(outcome).find(workspace.at("source=\"raw\"") +
                                     "unit 'motor': the library 'raw/binaries/") !=
        std::string::npos);
  CHECK_THAT(outcome.err, Contains("so it is cut off or damaged"));
}

TEST_CASE("a crash while a library is loaded names the component and the unit") {
  if (kSanitized) return;
  const Workspace workspace(Parts{component("meddler", "meddler.fmu")});
  ::setenv("STRIDE_MEDDLE", "load crash", 1);
  const Arguments arguments =
      GENERATE(Arguments{"run", "test.ssd", "--out", "out"}, Arguments{"check", "test.ssd"});
  const Outcome outcome = workspace.stride(arguments);
  ::unsetenv("STRIDE_MEDDLE");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains(workspace.at("meddler.fmu") +
                      "unit 'meddler': signal 6 (SIGABRT) ends stride in the loading of '") &&
                 Contains("/meddler.fmu/binaries/"));
}
