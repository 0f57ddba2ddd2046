// FMI 2.0 units, as a user of the program meets them.
#include <nlohmann/json.hpp>

#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// An FMI 2.0 unit that turns at 0.25 s between two of FMI 3.0, which are rolled back.
Parts mixed(const std::string& turner) {
  return {component("filter", "minimal.fmu") + component("turner", turner) +
              component("relaxation", "fmi2_relaxation.fmu") + component("last", "minimal.fmu"),
          connection("turner.y", "filter.u") + connection("filter.y", "relaxation.u") +
              connection("relaxation.x", "last.u")};
}

/// An FMU whose description is another's, with a part replaced, and without its libraries.
void write_other(const Workspace& workspace, const std::string& part,
                 const std::string& replacement) {
  const stride::importer::UnpackedFmu unpacked(test_fmu("fmi2_relaxation"));
  std::string text = read(unpacked.folder() / "modelDescription.xml");
  text.replace(text.find(part), part.size(), replacement);
  workspace.scratch().write("other/modelDescription.xml", text);
}

}  // namespace

TEST_CASE("inspect shows an FMI 2.0 unit") {
  const Outcome outcome =
      Workspace("").stride({"inspect", (test_unit_folder() / "fmi2_types.fmu").string()});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("fmi2_types: FMI 2.0 Co-Simulation\n"));
  CHECK_THAT(outcome.out, Contains("can be rolled back, variable step"));
  CHECK_THAT(outcome.out, Contains("gain.local"));
  CHECK_THAT(outcome.out, Contains("Enumeration"));
}

TEST_CASE("units of both versions run together, and a discarded step is redone by all") {
  const bool has_state = GENERATE(true, false);
  const std::string unit = has_state ? "fmi2_turner.fmu" : "fmi2_turner_without_state.fmu";
  const Workspace workspace(mixed(unit));
  const Outcome outcome = workspace.run({"--step", "0.1", "--quiet"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  const auto time = signals.numbers("time");
  const auto y = signals.numbers("turner.y");
  bool has_turn = false;
  for (std::size_t i = 0; i < time.size(); ++i) {
    CAPTURE(time[i]);
    CHECK(y[i] == Approx(time[i] <= 0.25 ? time[i] : 0.5 - time[i]).margin(1e-12));
    has_turn |= time[i] == 0.25;
  }
  CHECK(has_turn);
  const auto run = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(run.at("communication_steps") == 11);
  for (const auto& entry : run.at("units")) {
    CAPTURE(entry.dump());
    const bool is_turner = entry.at("name") == "turner";
    CHECK(entry.at("rejections") == (is_turner && has_state ? 1 : 0));
    CHECK(entry.at("early_returns") == (is_turner && !has_state ? 1 : 0));
  }
  if (has_state) CHECK(outcome.err == "");
  if (!has_state) {
    CHECK_THAT(outcome.err, Contains("warning: unit 'turner': the step to 0.3 s ended at 0.25 s"));
  }
}

TEST_CASE("check lists FMI 2.0 units as what they are") {
  const Outcome outcome = Workspace(mixed("fmi2_turner.fmu")).stride({"check", "test.ssd"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("2.0"));
  CHECK_THAT(outcome.out, Contains("can be rolled back; its state is saved before each step"));
}

TEST_CASE("start values of FMI 2.0 inputs and parameters are set from outside") {
  const Workspace workspace(Parts{component("r", "fmi2_relaxation.fmu")});
  const Outcome outcome = workspace.run({"--set", "r.u=3", "--set", "r.x=3", "--quiet"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  for (const double x : workspace.signals().numbers("r.x")) CHECK(x == 3);
  CHECK_THAT(input_error_of(workspace.run({"--set", "r.der(x)=1"})),
             Contains("initial = calculated cannot be set"));
  CHECK_THAT(input_error_of(workspace.run({"--set", "r.x=101"})), Contains("at most 100"));
}

TEST_CASE("units that cannot be loaded say what to do") {
  const Workspace workspace(Parts{component("r", "other")});
  write_other(workspace, "fmiVersion=\"2.0\"", "fmiVersion=\"4.0\"");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("fmiVersion=\"4.0\" is not supported; expected 1.0, 2.0 or 3.0") &&
                 Contains("hint: export the unit as FMI 3.0 or FMI 2.0 Co-Simulation"));
  write_other(workspace, "fmiVersion=\"2.0\"", "fmiVersion=\"3.0-beta.3\"");
  CHECK_THAT(
      input_error_of(workspace.run()),
      Contains("fmiVersion=\"3.0-beta.3\" is a draft of FMI 3.0, whose functions have other") &&
          Contains("hint: export the unit as FMI 3.0"));
  write_other(workspace, "CoSimulation", "ModelExchange");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("it has ModelExchange only") && Contains("hint: export the unit for"));
  write_other(workspace, "", "");
  workspace.scratch().write("other/sources/relaxation.c", "");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("it has its source code only") && Contains("hint: 'stride build FILE.fmu"));
  fs::create_directories(workspace / "other/binaries/linux64");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("the FMU's folder 'binaries/linux64' has no library; it is empty") &&
                 Contains("hint: expected 'binaries/linux64/"));
  workspace.scratch().write("other/binaries/linux64/unit.dll", "");
  CHECK_THAT(input_error_of(workspace.run()), Contains("has no library; it has unit.dll"));
  fs::remove_all(workspace / "other/binaries/linux64");
  workspace.scratch().write("other/binaries/win64/fmi2_relaxation.dll", "");
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("it has win64") && Contains("a Windows library cannot be loaded on Linux"));
}

TEST_CASE(
    "the failure of a unit of FMI 2.0 is reported with its message, and what was recorded is "
    "kept") {
  const Workspace workspace(Parts{component("g", "fmi2_grumbler.fmu")});
  const Outcome outcome = workspace.run({"--set", "g.mood=3", "--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'g', at 0 s: fmi2DoStep returned fmi2Error: mood of 3 in "
                                   "channel #4"));
  CHECK(workspace.signals().numbers("time") == std::vector<double>{0});
}

TEST_CASE("what has a start value can be set in a unit of FMI 1.0, an output, too") {
  const Workspace workspace(Parts{component("tank", "fmi1_tank.fmu")});
  const Outcome outcome = workspace.run({"--quiet", "--stop", "1", "--set", "tank.level=3"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto levels = workspace.signals().numbers("tank.level [m]");
  CHECK(levels.front() == 3);
  CHECK(levels.back() == Approx(4));
  const std::string refused = input_error_of(workspace.run({"--set", "tank.temper=1"}));
  CHECK_THAT(refused, Contains("a discrete local without a start value cannot be set") &&
                          Contains("in FMI 1.0") && !Contains("initial"));
}

TEST_CASE("others go back to where a unit of FMI 1.0 came in a step that it discarded") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("tank", "fmi1_hasty_tank.fmu"),
            connection("tank.level", "filter.u")});
  const Outcome outcome = workspace.run({"--quiet", "--step", "0.5", "--set", "tank.mood=3"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  CHECK(signals.numbers("time") == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  CHECK(signals.numbers("tank.level [m]").back() == 1);
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out,
             Contains("might complete a step in part, and discard the rest"));
}
