// The DefaultExperiment of a unit, as a user of the program meets it.
#include <nlohmann/json.hpp>

#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A unit, "NAME", that declares this experiment.
void write_unit(const Workspace& workspace, const std::string& name,
                const std::string& experiment) {
  const stride::importer::UnpackedFmu unpacked(test_fmu("fmi2_relaxation"));
  fs::copy(unpacked.folder(), workspace / name,
           fs::copy_options::recursive | fs::copy_options::update_existing);
  std::string text = read(unpacked.folder() / "modelDescription.xml");
  const std::size_t begin = text.find("<DefaultExperiment");
  text.replace(begin, text.find('>', begin) + 1 - begin, "<DefaultExperiment " + experiment + "/>");
  workspace.scratch().write(name + "/modelDescription.xml", text);
}

Outcome run_unit(const Workspace& workspace, const std::string& experiment,
                 const Arguments& further = {}) {
  write_unit(workspace, "unit", experiment);
  Arguments arguments{"run", "unit", "--out", "out", "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return workspace.stride(arguments);
}

std::vector<std::string> recorded_times(const Workspace& workspace) {
  const Csv signals = workspace.signals();
  std::vector<std::string> times;
  for (std::size_t i = 0; i < signals.size(); ++i) times.push_back(signals.row(i).front());
  return times;
}

}  // namespace

TEST_CASE("a run begins and ends at the times of its unit") {
  const Workspace workspace("");
  REQUIRE(run_unit(workspace, "startTime='3600' stopTime='3601' stepSize='0.5'").exit_code == 0);
  CHECK(recorded_times(workspace) == std::vector<std::string>{"3600", "3600.5", "3601"});
  REQUIRE(
      run_unit(workspace, "startTime='3600' stopTime='3601' stepSize='0.5'", {"--start", "3600.5"})
          .exit_code == 0);
  CHECK(recorded_times(workspace) == std::vector<std::string>{"3600.5", "3601"});
}

TEST_CASE("a run begins at the earliest start time of its units, and says so") {
  Parts parts{component("early", "early") + component("late", "late"), ""};
  parts.experiment = "<ssd:DefaultExperiment stopTime=\"4\"/>\n";
  const Workspace workspace(parts);
  write_unit(workspace, "early", "startTime='2' stepSize='1'");
  write_unit(workspace, "late", "startTime='3'");
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(recorded_times(workspace) == std::vector<std::string>{"2", "3", "4"});
  CHECK_THAT(outcome.err, Contains("the run begins at 2 s, the start time of 'early'; that of "
                                   "'late' is 3 s"));
  REQUIRE(workspace.run({"--quiet", "--start", "3"}).err == "");
  CHECK(recorded_times(workspace) == std::vector<std::string>{"3", "4"});
}

TEST_CASE("a run begins before 0 s where its unit does") {
  const Workspace workspace("");
  REQUIRE(run_unit(workspace, "startTime='-1' stopTime='1' stepSize='1'").exit_code == 0);
  CHECK(recorded_times(workspace) == std::vector<std::string>{"-1", "0", "1"});
}

TEST_CASE("a stop time of a unit beyond what can be counted is refused as that") {
  const Workspace workspace("");
  CHECK_THAT(input_error_of(run_unit(workspace, "stopTime='3.2e16'")),
             Contains("is beyond 1e15 s") && Contains("--stop SECONDS"));
  CHECK(run_unit(workspace, "stopTime='3.2e16'", {"--stop", "0.01"}).exit_code == 0);
}

TEST_CASE("a unit that asks for steps of a third of a second gets three in a second") {
  const Workspace workspace("");
  REQUIRE(run_unit(workspace, "stopTime='1' stepSize='0.3333333333333333'").exit_code == 0);
  CHECK(recorded_times(workspace) ==
        std::vector<std::string>{"0", "0.333333333333", "0.666666666667", "1"});
  CHECK(nlohmann::json::parse(workspace.result("run.json"))["step"]["size"] == 1.0 / 3);
}

TEST_CASE("the default step follows the stop time that the unit or the scenario declares") {
  const Workspace workspace("");
  const auto step = [&](const std::string& stop, const Arguments& further) {
    REQUIRE(run_unit(workspace, "stopTime='" + stop + "'", further).exit_code == 0);
    return nlohmann::json::parse(workspace.result("run.json"))["step"]["size"].get<double>();
  };
  CHECK(step("86400", {"--stop", "2"}) == 0.5);
  CHECK(step("1", {}) == 0.001);
  CHECK(step("0.01", {}) == 0.0001);
}

TEST_CASE("a run that will write very many rows says so when it begins") {
  const Workspace workspace("");
  write_unit(workspace, "unit", "stopTime='86400' stepSize='0.001'");
  CHECK_THAT(workspace.stride({"check", "unit"}).err,
             Contains("up to 86400000 steps of 0.001 s are made"));
  write_unit(workspace, "unit", "stopTime='86400' stepSize='0.01'");
  CHECK(workspace.stride({"check", "unit"}).err == "");
}
