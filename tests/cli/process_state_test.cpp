// Units that change what all code in their process shares: results are those of a well-behaved
// unit, with and without a host, and a warning names the unit and what it has changed.
#include <csignal>
#include <cstdlib>

#include "tests/build.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// What the unit `meddler` is to do, as long as it lives.
class Meddling {
 public:
  explicit Meddling(const std::string& wish) { ::setenv("STRIDE_MEDDLE", wish.c_str(), 1); }
  ~Meddling() { ::unsetenv("STRIDE_MEDDLE"); }
  Meddling(const Meddling&) = delete;
  Meddling& operator=(const Meddling&) = delete;
};

/// A unit, and others whose numbers depend on rounding and on subnormal numbers.
Workspace beside_others(const std::string& source) {
  return Workspace(Parts{component("meddler", source) + component("filter", "minimal.fmu") +
                         component("tiny", "feedthrough.fmu")});
}

Outcome run_without_meddling(const Workspace& workspace, const Arguments& further = {}) {
  Arguments arguments{"--quiet",           "--set", "filter.u=0.1", "--set",
                      "tiny.slope=1e-310", "--set", "tiny.u=1"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return workspace.run(arguments);
}

Outcome run_with(const Workspace& workspace, const std::string& wish,
                 const Arguments& further = {}) {
  const Meddling meddling(wish);
  return run_without_meddling(workspace, further);
}

/// Those of the numbers, since a run.json has wall-clock times.
std::string numbers(const Workspace& workspace) {
  CHECK((fs::status(workspace / "out/signals.csv").permissions() & fs::perms::owner_read) !=
        fs::perms::none);
  return workspace.result("signals.csv") + workspace.result("events.csv");
}

const std::string kAll =
    "folder,mask,variable,new variable,locale,interrupts,crashes,limit,rounding,flush,exceptions";

const std::vector<std::string> kNames{
    "the working folder",
    "umask",
    "the environment variables STRIDE_MEDDLED, TMPDIR",
    "the locale",
    "the handler of SIGINT",
    "the blocking of SIGINT",
    "a resource limit",
};

}  // namespace

TEST_CASE("what a unit changes until the end of the initialization is put back") {
  const Workspace workspace = beside_others("meddler.fmu");
  REQUIRE(run_without_meddling(workspace).err == "");
  const std::string expected = numbers(workspace);
  CHECK_THAT(expected, Contains("1e-310"));
  const auto [phase, where] = GENERATE(table<std::string, std::string>({
      {"load", "the loading of its library"},
      {"instantiate", "fmi3InstantiateCoSimulation"},
      {"initialize", "fmi3ExitInitializationMode"},
  }));
  INFO(phase);
  const Outcome here = run_with(workspace, phase + " " + kAll);
  INFO(here.err);
  CHECK(here.exit_code == 0);
  CHECK_THAT(here.err, Contains("unit 'meddler': " + where + " changed "));
  for (const std::string& name : kNames) CHECK_THAT(here.err, Contains(name));
  CHECK_THAT(here.err, Contains("rounding upward"));
  if (!kSanitized) CHECK_THAT(here.err, Contains("the handler of SIGSEGV"));
  CHECK(numbers(workspace) == expected);
  CHECK(workspace.left_behind().empty());
  const Outcome hosted =
      run_with(workspace, phase + " locale,rounding,flush", {"--isolate=meddler"});
  INFO(hosted.err);
  CHECK(hosted.exit_code == 0);
  CHECK_THAT(hosted.err, Contains("unit 'meddler': " + where) && Contains("the locale") &&
                             Contains("rounding upward"));
  CHECK(numbers(workspace) == expected);
}

TEST_CASE("what a unit changes in its steps is put back at the end, the numbers' part at once") {
  const Workspace workspace = beside_others("meddler.fmu");
  REQUIRE(run_without_meddling(workspace).exit_code == 0);
  const std::string expected = numbers(workspace);
  const auto [phase, function] = GENERATE(table<std::string, std::string>({
      {"event", "fmi3UpdateDiscreteStates"},
      {"step", "fmi3DoStep"},
      {"terminate", "fmi3Terminate"},
  }));
  INFO(phase);
  const std::string mode = "unit 'meddler': " + function + " left another mode of the processor";
  const Outcome here = run_with(workspace, phase + " " + kAll);
  INFO(here.err);
  CHECK(here.exit_code == 0);
  CHECK_THAT(here.err, Contains(mode) && Contains("rounding upward, subnormal numbers become 0"));
  CHECK_THAT(here.err, Contains("one of the units without a host has changed "));
  for (const std::string& name : kNames) CHECK_THAT(here.err, Contains(name));
  CHECK(numbers(workspace) == expected);
  CHECK(workspace.left_behind().empty());
  const Outcome parallel =
      run_with(workspace, phase + " rounding,flush,exceptions", {"--threads=2"});
  CHECK(parallel.exit_code == 0);
  CHECK(numbers(workspace) == expected);
  const Outcome hosted = run_with(workspace, phase + " " + kAll, {"--isolate=meddler"});
  INFO(hosted.err);
  CHECK(hosted.exit_code == 0);
  CHECK_THAT(hosted.err, Contains(mode) && !Contains("has changed"));
  CHECK(numbers(workspace) == expected);
}

TEST_CASE("registers that a unit leaves in use are emptied, with or without a host") {
  const Workspace workspace = beside_others("meddler.fmu");
  REQUIRE(run_without_meddling(workspace).exit_code == 0);
  const std::string expected = numbers(workspace);
  const auto [wish, function] = GENERATE(table<std::string, std::string>(
      {{"initialize registers", "fmi3ExitInitializationMode"}, {"step registers", "fmi3DoStep"}}));
  for (const Arguments& options : {Arguments{}, Arguments{"--isolate=meddler"}}) {
    const Outcome outcome = run_with(workspace, wish, options);
    CHECK(outcome.exit_code == 0);
#if defined(__x86_64__)
    CHECK_THAT(outcome.err,
               Contains("unit 'meddler': " + function + " left registers of x87 or MMX in use"));
#endif
    CHECK(numbers(workspace) == expected);
  }
}

TEST_CASE("streams of C++ that a unit has replaced are put back") {
  const Workspace workspace = beside_others("meddler.fmu");
  const std::string phase = GENERATE("load", "instantiate", "initialize", "step", "terminate");
  INFO(phase);
  const Outcome outcome = run_with(workspace, phase + " streams");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
}

TEST_CASE("inputs within a step are computed in the mode of stride, and the unit keeps its own") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("meddler", "meddler.fmu"),
            connection("filter.y", "meddler.u")});
  // the step is a power of 2, so the unit's own times are the same in any mode
  const Arguments options{"--quiet", "--set",  "filter.u=0.1", "--extrapolation",
                          "linear",  "--step", "0.0009765625"};
  REQUIRE(workspace.run(options).err == "");
  const std::string expected = numbers(workspace);
  const Meddling meddling("within rounding");
  const Outcome outcome = workspace.run(options);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(numbers(workspace) == expected);
}

TEST_CASE("the only unit without a host is the one that has changed the process") {
  const Workspace workspace = beside_others("meddler.fmu");
  const Outcome outcome = run_with(workspace, "step folder",
                                   {"--isolate=filter", "--isolate=tiny", "--junit", "report.xml"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("unit 'meddler' has changed the working folder"));
  CHECK(fs::exists(workspace / "out/report.html"));
  CHECK_THAT(read(workspace / "report.xml"), Contains("<testcase"));
}

TEST_CASE("FMI 2.0: a mode of the processor that a step leaves behind") {
  const Workspace workspace = beside_others("fmi2_faulty.fmu");
  // the step is a power of 2, so the unit's own times are the same in any mode
  const Arguments step{"--step", "0.0009765625"};
  REQUIRE(run_without_meddling(workspace, step).exit_code == 0);
  const std::string expected = numbers(workspace);
  const FaultOrder order("round up", "step", "0.5");
  const Outcome outcome = run_without_meddling(workspace, step);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("fmi2DoStep left another mode of the processor behind"));
  CHECK(numbers(workspace) == expected);
}

TEST_CASE("a unit that is linked with -ffast-math changes no number, with or without a host") {
  const Workspace workspace = beside_others("meddler_fast_math.fmu");
  REQUIRE(run_without_meddling(workspace, {"--swap", "meddler=meddler.fmu"}).exit_code == 0);
  const std::string expected = numbers(workspace);
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  const Outcome outcome = run_without_meddling(workspace, hosting);
  CHECK(outcome.exit_code == 0);
  // later ones leave the mode as it is where a shared library is linked
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ < 13
  CHECK_THAT(outcome.err, Contains("unit 'meddler': the loading of its library changed the "
                                   "mode of the processor (subnormal numbers become 0"));
#endif
  CHECK(numbers(workspace) == expected);
}

TEST_CASE("Ctrl-C ends a run in order, whatever a unit did to it when it was made") {
  const Workspace workspace = beside_others("meddler.fmu");
  const Meddling meddling("instantiate interrupts,folder");
  Process process(stride_command(Workspace::run_arguments({"--stop", "1e6", "--no-trace"})),
                  workspace.scratch().path());
  await_first_results(process, workspace);
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the run was interrupted"));
  CHECK(run_json(workspace)["outcome"] == "interrupted");
}

TEST_CASE("a crash in another folder is reported where the command was given") {
  if (kSanitized) return;
  const Workspace workspace = beside_others("meddler.fmu");
  const std::string phase = GENERATE("instantiate", "step");
  const Outcome outcome =
      run_with(workspace, phase + " folder,crashes,crash", {"--junit", "report.xml"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("signal 6 (SIGABRT) ends stride in fmi3"));
  CHECK_THAT(read(workspace / "report.xml"), Contains("SIGABRT"));
  if (phase == "step") CHECK(fs::exists(workspace / "out/report.html"));
}

TEST_CASE("a unit that stays in the folder of its FMU runs in a process of its own") {
  const Workspace workspace(Parts{component("wanderer", "fmi2_wanderer.fmu")});
  const Outcome here = workspace.run({"--quiet"});
  CHECK(here.exit_code == 1);
  CHECK_THAT(here.err, Contains("fmi2Instantiate changed the working folder") &&
                           Contains("--isolate=wanderer") &&
                           Contains("modelDescription.xml is not there"));
  const Outcome apart = workspace.run({"--quiet", "--isolate=wanderer"});
  INFO(apart.err);
  CHECK(apart.exit_code == 0);
  CHECK(workspace.signals().numbers("wanderer.size").back() > 100);
}

TEST_CASE("what Python's interpreter changes when it begins is put back without a warning") {
  const Scratch scratch;
  make_raw_fmu(scratch, "raw_with_python", "");
  scratch.write("test.ssd", scenario_text({component("unit", "raw_with_python")}));
  const auto run = [&](const char* level) {
    return run_program({"run", "test.ssd", level, "--stop", "1", "--step", "1", "--out", "out"},
                       scratch.path());
  };
  const Outcome quiet = run("--quiet");
  if (quiet.exit_code == 2) {  // there is no such library
    CHECK_THAT(quiet.err, Contains("the unit embeds Python"));
    return;
  }
  CHECK_THAT(quiet.err, !Contains("SIGXFSZ"));
  CHECK_THAT(run("--verbose").err, Contains("changed the handler of SIGXFSZ; it is put back"));
}
