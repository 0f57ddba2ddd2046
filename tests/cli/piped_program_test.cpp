// Programs as units: packed from their declarations, run, and what is left of them.
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const fs::path kExample = fs::path(STRIDE_SOURCE_DIR) / "units/process/resources";

/// One cistern, which fills up once and is asked every 10 ms.
Parts cistern(const std::string& source) {
  return {component("cistern", source), "", "<stride:Step size=\"0.01\"/>\n",
          "<ssd:DefaultExperiment stopTime=\"2\"/>\n"};
}

Arguments filling(Arguments further = {}) {
  further.insert(further.end(), {"--set", "cistern.inflow=0.7", "--quiet", "--no-trace"});
  return further;
}

std::string results(const Workspace& workspace) {
  return workspace.result("signals.csv") + workspace.result("events.csv");
}

/// What keeps the example but for its program.
std::string declaration(const std::string& program) {
  std::string text = read(kExample / "process.xml");
  const std::size_t begin = text.find("<program");
  return text.replace(begin, text.find("<parameter") - begin, program + "\n\n  ");
}

bool is_running(int id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  std::getline(status, text);
  return !text.empty() && text[text.rfind(')') + 2] != 'Z';
}

bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

bool is_swept(const Workspace& workspace) {
  try {
    return workspace.left_behind().empty();
  } catch (const fs::filesystem_error&) {  // just when something went
    return false;
  }
}

/// The number that a program writes into a file when it has started.
int number_in(const fs::path& file) {
  for (int i = 0; i < 20'000; ++i) {
    int number = 0;
    if (std::ifstream(file) >> number) return number;
    std::this_thread::sleep_for(1ms);
  }
  throw std::runtime_error("the program has not started");
}

}  // namespace

TEST_CASE("the example in Python and the one in C++ give the same bytes") {
  const Workspace in_cpp(cistern("cistern.fmu"));
  REQUIRE(in_cpp.run(filling()).exit_code == 0);
  CHECK_THAT(in_cpp.result("events.csv"),
             Contains(",cistern,alarm.text,sent,full with 1.0 m3,\n") &&
                 Contains("\n1.5,0,cistern,report.text,sent,1.0 m3,\n"));
  const Workspace in_python(cistern("packed.fmu"));
  for (const char* file : {"process.xml", "cistern.py"}) {
    fs::copy_file(kExample / file, in_python / file);
  }
  const Outcome packed = in_python.stride({"pack", "process.xml", "-o", "packed.fmu"});
  CHECK(packed.err == "");
  REQUIRE(packed.exit_code == 0);
  fs::remove(in_python / "cistern.py");
  REQUIRE(in_python.run(filling()).exit_code == 0);
  CHECK(results(in_python) == results(in_cpp));
}

TEST_CASE("a process of its own for the unit changes nothing") {
  const Workspace workspace(cistern("cistern.fmu"));
  REQUIRE(workspace.run(filling()).exit_code == 0);
  const std::string near = results(workspace);
  const Outcome hosted = workspace.run(filling({"--isolate"}));
  CHECK(hosted.err == "");
  CHECK(results(workspace) == near);
}

TEST_CASE("a program that lost its permission to be executed in an archive runs in a host, too") {
  const Workspace workspace(cistern("unpacked"));
  const std::string unpack = "python3 -m zipfile -e '" + test_fmu("cistern").string() + "' '" +
                             (workspace / "unpacked").string() + "'";
  REQUIRE(std::system(unpack.c_str()) == 0);  // which keeps no permissions
  const fs::path program = workspace / "unpacked/resources/cistern";
  REQUIRE((fs::status(program).permissions() & fs::perms::owner_exec) == fs::perms::none);
  const Outcome outcome = workspace.run(filling({"--isolate"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("check and run know that a snapshot would leave a unit's program behind") {
  const Parts two = {component("one", "cistern.fmu") + component("two", "cistern.fmu"), "",
                     "<stride:Step size=\"0.3\"/>\n", "<ssd:DefaultExperiment stopTime=\"2\"/>\n"};
  const Workspace workspace(two);
  const std::string refused = input_error_of(workspace.run({"--quiet"}));
  CHECK_THAT(refused, Contains("'one' and 'two' may both return early") &&
                          Contains("<stride:EarlyReturn components=\"two\" allowed=\"false\"/>") &&
                          !Contains("snapshots"));
  CHECK(input_error_of(workspace.stride({"check", "test.ssd"})) == refused);
  Parts one_stops = two;
  one_stops.annotation += "<stride:EarlyReturn components=\"two\" allowed=\"false\"/>\n";
  CHECK(Workspace(one_stops).run({"--quiet"}).exit_code == 0);
}

TEST_CASE("error control refuses a unit with a program, and names what makes it run") {
  const Workspace workspace(cistern("cistern.fmu"));
  const std::string refused = input_error_of(workspace.run({"--policy", "error-controlled"}));
  CHECK_THAT(refused, Contains("cannot be rolled back: 'cistern'") &&
                          Contains("use the policy 'fixed' or 'event-driven'") &&
                          !Contains("process=\"true\""));
  const Arguments check{"check", "test.ssd", "--policy", "error-controlled"};
  CHECK(input_error_of(workspace.stride(check)) == refused);
  CHECK(workspace.run({"--quiet", "--policy", "fixed"}).exit_code == 0);
}

TEST_CASE("snapshots of a unit with a program are not taken, which is said") {
  Parts parts = cistern("cistern.fmu");
  parts.annotation += "<stride:Host components=\"*\" snapshots=\"true\"/>\n";
  const Workspace workspace(parts);
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("unit 'cistern': it gets no snapshots, which test.ssd:"));
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out,
             Contains("no: they would not hold what it has outside of its process"));
}

TEST_CASE("a file outside is not packed, and found where it is") {
  const Workspace workspace(cistern("../units/outside.fmu"));
  fs::create_directories(workspace / "source");
  fs::copy_file(kExample / "cistern.py", workspace / "source/cistern.py");
  workspace.scratch().write(
      "declared/cistern.xml",
      declaration("<program name=\"python3\"/>"
                  "<argument file=\"../source/cistern.py\" outside=\"true\"/>"));
  REQUIRE(workspace.stride({"pack", "declared/cistern.xml", "-o", "outside.fmu"}).exit_code == 0);
  const Arguments run = {"inspect", "outside.fmu"};
  CHECK_THAT(workspace.stride(run).out, Contains("report_period"));
  workspace.scratch().write("outside.ssd", scenario_text(cistern("outside.fmu")));
  const Arguments start = {"run", "outside.ssd", "--out", "out", "--quiet", "--stop", "0.02"};
  CHECK(workspace.stride(start).exit_code == 0);
  fs::remove(workspace / "source/cistern.py");
  const Outcome gone = workspace.stride(start);
  CHECK(gone.exit_code == 1);
  CHECK_THAT(gone.err, Contains("there is no " + (workspace / "source/cistern.py").string()) &&
                           Contains("pack the declaration again"));
}

TEST_CASE("a program that cannot be packed is reported with the line of its declaration") {
  const Workspace workspace(cistern("none.fmu"));
  const auto [program, expected] = GENERATE(table<std::string, std::string>({
      {"<program file=\"absent\"/>", "other.xml:4: file=\"absent\": there is no file "},
      {"<program name=\"x\"/><file file=\"a/x\"/><file file=\"b/x\"/>",
       "all files of a program lie in one folder"},
      {"<program name=\"x\"/><knob/>", "other.xml:4: <knob>: not known here"},
      {"", "other.xml:3: <process>: expected <program file="},
  }));
  for (const char* file : {"a/x", "b/x"}) workspace.scratch().write(file, "");
  workspace.scratch().write("other.xml", declaration(program));
  const Outcome outcome = workspace.stride({"pack", "other.xml", "-o", "none.fmu"});
  CHECK_THAT(input_error_of(outcome), Contains(expected));
  CHECK_FALSE(fs::exists(workspace / "none.fmu"));
  workspace.scratch().write("other.xml", "<ssd/>");
  CHECK_THAT(input_error_of(workspace.stride({"pack", "other.xml", "-o", "none.fmu"})),
             Contains("other.xml:1: <ssd> is not a declaration of a program"));
  workspace.scratch().write("other.xml", declaration("<program name=\"x\"/>"));
  CHECK_THAT(input_error_of(workspace.stride({"pack", "other.xml", "-o", "none.fmu", "--resources",
                                              workspace.scratch().path()})),
             Contains("a program is packed with the unit process"));
}

TEST_CASE("a program that fails ends the run, with all results up to there") {
  const Workspace workspace(cistern("cistern.fmu"));
  workspace.scratch().write(
      "failing.sh",
      "#!/bin/sh\n"
      "while read -r line; do\n"
      "  case $line in '<start'*) t=0;; '<step'*) t=$((t + 10000000000));; *) continue;; esac\n"
      "  [ $t = 50000000000 ] && echo 'out of water' >&2 && exit 6\n"
      "  echo '<output name=\"volume\" value=\"'$t'\"/>'\n"
      "  echo '<output name=\"alarms\" value=\"0\"/>'\n"
      "  echo '<sync time=\"'$t'\"/>'\n"
      "done\n");
  const Outcome outcome =
      workspace.run({"--set", "cistern.process.program=./failing.sh", "--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains(workspace.at("<ssd:Component") + "unit 'cistern', at 0.04 s: fmi3DoStep") &&
                 Contains("the program 'failing.sh' ended with the exit code 6") &&
                 Contains("out of water"));
  CHECK(workspace.signals().size() == 5);  // 0 to 0.04 s
}

TEST_CASE("no program outlives the run, even if that is killed") {
  Parts parts = cistern("cistern.fmu");
  parts.components += component("other", "minimal.fmu");  // with another STRIDE_RESULTS
  const Workspace workspace(parts);
  workspace.scratch().write("endless.sh",
                            "#!/bin/sh\necho $$ > $STRIDE_RESULTS/number\nexec sleep 1000\n");
  fs::permissions(workspace / "endless.sh", fs::perms::owner_all);  // a host cannot
  const bool is_hosted = GENERATE(false, true);
  Arguments arguments =
      Workspace::run_arguments({"--set", "cistern.process.program=./endless.sh", "--quiet"});
  if (is_hosted) arguments.insert(arguments.end(), {"--isolate"});
  Process run(stride_command(arguments), workspace.scratch().path());
  const int program = number_in(workspace / "out/units/cistern/number");
  CHECK(is_running(program));
  run.send(SIGKILL);
  run.wait();
  CHECK(comes_true([&] { return !is_running(program); }));
  // the supervisor of a host removes temporary folders, and ends
  CHECK(comes_true([&] { return !is_hosted || is_swept(workspace); }));
}
