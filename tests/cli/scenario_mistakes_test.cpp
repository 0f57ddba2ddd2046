// Mistakes in a scenario: exit code 2, the place, and how to mend it.
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// `run` and `check` find the same mistake and write nothing.
std::string mistake_in(const Workspace& workspace) {
  const Outcome run = workspace.run();
  CHECK(run.exit_code == 2);
  CHECK(run.out == "");
  CHECK_FALSE(fs::exists(workspace / "out"));
  const Outcome check = workspace.stride({"check", "test.ssd"});
  CHECK(check.exit_code == 2);
  CHECK(check.err == run.err);
  CHECK(workspace.left_behind().empty());
  return run.err;
}

Parts with_connection(const std::string& from, const std::string& to) {
  return {component("filter", "minimal.fmu") + component("types", "types.fmu") +
              component("stepper", "stepper.fmu"),
          connection(from, to)};
}

/// A model description with these units defined.
std::string with_units(const std::string& units, std::string description) {
  const std::string definitions = "<UnitDefinitions>" + units + "</UnitDefinitions>\n";
  return description.insert(description.find("<ModelVariables>"), definitions);
}

}  // namespace

TEST_CASE("a scenario that is not there") {
  const Outcome outcome = run_program({"run", "nowhere/test.ssd"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, StartsWith("stride: error: nowhere/test.ssd: the file does not exist"));
}

TEST_CASE("a scenario that is not XML names the file and the line") {
  std::string text = scenario_text(two_filters());
  text.erase(text.find("</ssd:Connections>"), std::string("</ssd:Connections>").size());
  const Workspace workspace(text);
  CHECK_THAT(mistake_in(workspace), StartsWith("stride: error: " + workspace.at("</ssd:System>")) &&
                                        Contains("not well-formed XML: </ssd:System>") &&
                                        Contains("before the end tag of <ssd:Connections>"));
}

TEST_CASE("a scenario that is another kind of file") {
  const Workspace workspace("<html/>\n");
  CHECK_THAT(mistake_in(workspace),
             Contains("test.ssd:1: ") && Contains("expected a system structure description"));
}

TEST_CASE("an unknown component in a connection is answered with the nearest one") {
  const Workspace workspace(with_connection("fliter.y", "types.float64"));
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("<ssd:Connection ")) &&
                                        Contains("there is no component 'fliter'") &&
                                        Contains("did you mean 'filter'?"));
}

TEST_CASE("an unknown variable in a connection is answered with the nearest one") {
  const Workspace workspace(with_connection("stepper.positoin", "filter.u"));
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<ssd:Connection ") + "unit 'stepper', variable 'positoin'") &&
                 Contains("did you mean 'position'?"));
}

TEST_CASE("an unknown variable in a connector is answered with the nearest one") {
  const Workspace workspace(Parts{
      component("filter", "minimal.fmu",
                "\n" + connector("time_constnat", "parameter", "<ssc:Float64 unit=\"s\"/>"))});
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("<ssd:Connector ")) &&
                                        Contains("did you mean 'time_constant'?"));
}

TEST_CASE("an unknown unit names the places searched and the nearest unit") {
  const Workspace workspace(Parts{component("filter", "minimla.fmu")});
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<ssd:Component ") + "there is no unit 'minimla.fmu'") &&
                 Contains(unit_folder().string()) && Contains("did you mean 'minimal.fmu'?"));
}

TEST_CASE("a unit that lies in another folder near the scenario is told with its folder") {
  const std::pair<const char*, const char*> kPlaces[] = {{"units/host.fmu", "host.fmu"},
                                                         {"host.fmu", "models/host.fmu"},
                                                         {"units/host.fmu", "models/host.fmu"},
                                                         {"../units/host.fmu", "host.fmu"}};
  for (const auto& [source, place] : kPlaces) {
    const Workspace workspace(Parts{component("filter", source)});
    fs::create_directories((workspace / place).parent_path());
    fs::copy(unit_folder() / "minimal.fmu", workspace / place);
    CHECK_THAT(mistake_in(workspace), Contains(std::string("did you mean '") + place + "'?"));
  }
}

TEST_CASE("a unit that is still a file of Python is told how to be packed") {
  const Workspace workspace(Parts{component("pump", "Pump.fmu")});
  workspace.scratch().write("pump.py", "");
  CHECK_THAT(mistake_in(workspace),
             Contains("packed first: python3 -m stride.unit pump.py -o Pump.fmu"));
}

TEST_CASE("an unknown unit is answered with the one beside the scenario") {
  const Workspace workspace(Parts{component("filter", "hosst.fmu")});
  fs::copy(unit_folder() / "minimal.fmu", workspace / "host.fmu");
  CHECK_THAT(mistake_in(workspace), Contains("did you mean 'host.fmu'?"));
}

TEST_CASE("an unknown element in the annotation is answered with the nearest one") {
  Parts parts = two_filters();
  parts.annotation = "<stride:Stpe size=\"0.001\"/>\n";
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<stride:Stpe ") + "<stride:Stpe> is not known") &&
                 Contains("did you mean 'Step'?"));
}

TEST_CASE("an unknown attribute in the annotation is answered with the nearest one") {
  Parts parts = two_filters();
  parts.annotation = "<stride:Step szie=\"0.001\"/>\n";
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<stride:Step ")) && Contains("did you mean 'size'?"));
}

TEST_CASE("a connection between two types names both") {
  const Workspace workspace(with_connection("filter.y", "types.int32"));
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("<ssd:Connection ")) &&
                                        Contains("'filter.y' to 'types.int32'") &&
                                        Contains("Float64 and Int32 are different types"));
}

TEST_CASE("a connection between two dimensions names both units") {
  Parts parts = with_connection("stepper.position", "heater.power");
  parts.components += component("heater", "raw");
  const Workspace workspace(parts);
  make_raw_fmu(workspace.scratch(), "raw");
  workspace.scratch().write(
      "raw/modelDescription.xml",
      with_units(R"(<Unit name="W"><BaseUnit kg="1" m="2" s="-3"/></Unit>)",
                 description_text("raw", "",
                                  R"(<Float64 name="power" valueReference="1" causality="input" )"
                                  R"(start="0" unit="W"/>)")));
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<ssd:Connection ")) &&
                 Contains("'stepper.position' is in 'm', 'heater.power' in 'W'") &&
                 Contains("suppressUnitConversion"));
}

TEST_CASE("a connector in another dimension than the unit's variable") {
  const Workspace workspace(Parts{
      component("filter", "minimal.fmu",
                "\n" + connector("time_constant", "parameter", "<ssc:Float64 unit=\"m\"/>"))});
  CHECK_THAT(
      mistake_in(workspace),
      Contains(workspace.at("<ssd:Connector ") + "unit 'filter', variable 'time_constant'") &&
          Contains("the connector is in 'm', the unit's variable in 's'"));
}

TEST_CASE("a connection against the direction of its variables") {
  const Workspace workspace(with_connection("types.float64.echo", "filter.time_constant"));
  CHECK_THAT(mistake_in(workspace),
             Contains(workspace.at("<ssd:Connection ")) &&
                 Contains("'filter.time_constant' is not an input but parameter"));
}

TEST_CASE("an input with two sources names both and both lines") {
  Parts parts = two_filters();
  parts.connections += connection("second.y", "second.u");
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("startElement=\"second\"")) &&
                                        Contains("'second.y' here and 'first.y' in line") &&
                                        Contains("remove one of the two connections"));
}

TEST_CASE("a unit bound to the main thread that is not there") {
  Parts parts = two_filters();
  parts.annotation = "<stride:MainThread components=\"second frist\"/>\n";
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("<stride:MainThread ")) &&
                                        Contains("'frist' matches no component") &&
                                        Contains("did you mean 'first'?"));
}

TEST_CASE("a unit that must not return early and is not there") {
  Parts parts = two_filters();
  parts.annotation = "<stride:EarlyReturn components=\"frist\" allowed=\"false\"/>\n";
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("<stride:EarlyReturn ")) &&
                                        Contains("'frist' matches no component") &&
                                        Contains("did you mean 'first'?"));
}

TEST_CASE("two components of one name") {
  Parts parts = two_filters();
  parts.components += component("first", "types.fmu");
  const Workspace workspace(parts);
  CHECK_THAT(mistake_in(workspace), Contains(workspace.at("source=\"types.fmu\"")) &&
                                        Contains("two components are named 'first'"));
}
