// Units in process that close or replace open files which are not theirs: the rows are kept, and it
// is an error.
#include "tests/build.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

Outcome run_with_file_fault(const Workspace& workspace, const char* fault, Arguments further = {}) {
  const FaultOrder order(fault, "step", "0.5");
  further.insert(further.end(), {"--quiet", "--step", "0.125"});
  return workspace.run(further);
}

Workspace with_file_faults(const std::string& version) {
  return Workspace(Parts{component("first", "minimal.fmu") +
                         component("faulty", "fmi" + version + "_faulty.fmu")});
}

}  // namespace

TEST_CASE("a unit that closes or replaces all open files fails the run, and loses no row") {
  const Workspace workspace = with_file_faults(GENERATE("2", "3"));
  REQUIRE(workspace.run({"--quiet", "--step", "0.125"}).exit_code == 0);
  const std::string expected = workspace.result("signals.csv");
  const char* const fault = GENERATE("close files", "replace files", "keep closing files");
  if (kSanitized && std::string(fault) == "keep closing files") return;  // a race of the unit's
  INFO(fault);
  const Outcome outcome = run_with_file_fault(workspace, fault);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(workspace.result("signals.csv") == expected);
  CHECK(workspace.left_behind().empty());
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  CHECK_THAT(run["error"].get<std::string>(),
             Contains("out/signals.csv: at 1 s: other code in this process, such as that of a "
                      "unit, has closed the open file or put another one in its place; the lines "
                      "up to here are complete"));
  CHECK(outcome.err.find("working folder") == std::string::npos);
}

TEST_CASE("a hosted unit that closes or replaces all open files disturbs nothing") {
  const Workspace workspace = with_file_faults("3");
  const Outcome outcome = run_with_file_fault(workspace, GENERATE("close files", "replace files"),
                                              {"--isolate=faulty"});
  CHECK(outcome.exit_code == 0);
  CHECK(last_time(workspace) == "1");
}

TEST_CASE("a unit that closes files by which a host is led is named") {
  const Workspace workspace(
      Parts{component("first", "minimal.fmu") + component("faulty", "fmi3_faulty.fmu"), "",
            "<stride:Results signals=\"none\" events=\"none\" trace=\"none\"/>"});
  const FaultOrder order(GENERATE("close files", "replace files"), "step", "0.5");
  const Outcome outcome = workspace.run({"--quiet", "--stop", "1e6", "--isolate=first"});
  CHECK(outcome.exit_code == 1);
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  CHECK_THAT(run["error"].get<std::string>(),
             Contains("unit 'first', at ") &&
                 Contains("such as that of a unit without a host ('faulty'), has closed the open "
                          "file by which it is led, or put another one in its place") &&
                 Contains("hint: a unit may close its own files only"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a unit that moves within open files does no harm") {
  const Workspace workspace = with_file_faults("3");
  const std::string expected = [&] {
    REQUIRE(workspace.run({"--quiet", "--step", "0.0001"}).exit_code == 0);
    return workspace.result("signals.csv");
  }();
  const FaultOrder order("move in files", "step", "0.5");
  CHECK(workspace.run({"--quiet", "--step", "0.0001"}).exit_code == 0);
  CHECK(workspace.result("signals.csv") == expected);
}

TEST_CASE("a results file that a unit has cut off is an error") {
  const Workspace workspace = with_file_faults("3");
  const FaultOrder order("cut files", "step", "1");
  const Outcome outcome = workspace.run({"--quiet", "--step", "0.0001"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("other code has cut the file off while it was written"));
}
