#include "master/system/declaration/scenario.h"

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;
using core::Causality;
using core::ValueType;

namespace {

Scenario read(const std::string& text) {
  const TemporaryFolder folder;
  return read_scenario(folder.write("x.ssd", text));
}

const std::string kComponent = "<ssd:Component name='a' source='a.fmu'/>";

}  // namespace

TEST_CASE("A scenario is read as it is written") {
  const TemporaryFolder folder;
  const Scenario scenario = read_scenario(folder.write("x.ssd", ssd(R"(
<ssd:System name="root">
  <ssd:Elements>
    <ssd:Component name="a" source="units/a%20b.fmu" type="application/x-fmu-sharedlibrary"
                   implementation="CoSimulation" description="the first">
      <ssd:Connectors>
        <ssd:Connector name="x" kind="output"><ssc:Float64 unit="m"/></ssd:Connector>
        <ssd:Connector name="n" kind="input"><ssc:UInt16/><ssc:Dimension size="2"/></ssd:Connector>
        <ssd:Connector name="r" kind="parameter"><ssc:Real unit="s"/></ssd:Connector>
        <ssd:Connector name="i" kind="local"><ssc:Integer/></ssd:Connector>
        <ssd:Connector name="f" kind="output"><ssc:Binary/><ssd:Clock name="c"/></ssd:Connector>
        <ssd:Connector name="c" kind="output"><ssc:Clock/><ssd:ConnectorGeometry x="0" y="0"/>
        </ssd:Connector>
        <ssd:Connector name="u" kind="unspecified"/>
      </ssd:Connectors>
      <ssd:ElementGeometry x1="0" y1="0" x2="1" y2="1"/>
    </ssd:Component>
    <ssd:Component name="b" source="b.fmu"/>
  </ssd:Elements>
  <ssd:Connections>
    <ssd:Connection startElement="a" startConnector="x" endElement="b" endConnector="y">
      <ssd:ConnectionGeometry pointsX="0" pointsY="0"/>
    </ssd:Connection>
    <ssd:Connection startElement="b" startConnector="z" endElement="a" endConnector="n"
                    suppressUnitConversion="true"/>
  </ssd:Connections>
  <ssd:SystemGeometry x1="0" y1="0" x2="1" y2="1"/>
  <ssd:GraphicalElements><ssd:Note x1="0" y1="0" x2="1" y2="1" text="n"/></ssd:GraphicalElements>
</ssd:System>
<ssd:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssd:Units>
<ssd:DefaultExperiment startTime="0.5" stopTime="3e1"/>
<ssd:Annotations><ssc:Annotation type="com.other"><x/></ssc:Annotation></ssd:Annotations>)")));

  CHECK(scenario.name == "test");
  CHECK(scenario.ssp_version == "2.0");
  CHECK(scenario.start == Time(Duration(500'000'000'000)));
  CHECK(scenario.stop == Time(std::chrono::seconds(30)));
  CHECK(scenario.system.name == "root");
  CHECK(scenario.sources == std::vector{folder / "units/a b.fmu", folder / "b.fmu"});
  REQUIRE(scenario.system.components.size() == 2);
  const core::ComponentDeclaration& a = scenario.system.components[0];
  CHECK(a.name == "a");
  CHECK(a.description == nullptr);
  CHECK(a.where.line == 6);
  CHECK(a.where.file == (folder / "x.ssd").string());
  REQUIRE(a.connectors.size() == 7);
  CHECK(a.connectors[0].name == "x");
  CHECK(a.connectors[0].type == ValueType::Float64);
  CHECK(a.connectors[0].causality == Causality::Output);
  CHECK(a.connectors[0].unit.name == "m");
  CHECK(a.connectors[0].where.line == 9);
  CHECK(a.connectors[1].type == ValueType::UInt16);
  CHECK(a.connectors[1].causality == Causality::Input);
  CHECK(a.connectors[2].type == ValueType::Float64);
  CHECK(a.connectors[2].causality == Causality::Parameter);
  CHECK(a.connectors[3].type == ValueType::Int32);
  CHECK(a.connectors[4].type == ValueType::Binary);
  CHECK(a.connectors[5].type == ValueType::Clock);
  CHECK(a.connectors[6].type == std::nullopt);
  CHECK(a.connectors[6].causality == std::nullopt);
  CHECK(scenario.system.components[1].connectors.empty());
  REQUIRE(scenario.system.connections.size() == 2);
  const core::ConnectionDeclaration& wire = scenario.system.connections[0];
  CHECK(wire.from_component + "." + wire.from_connector == "a.x");
  CHECK(wire.to_component + "." + wire.to_connector == "b.y");
  CHECK_FALSE(wire.suppress_unit_conversion);
  CHECK(wire.where.line == 23);
  CHECK(scenario.system.connections[1].suppress_unit_conversion);
  CHECK(scenario.system.start_values.empty());
}

TEST_CASE("In SSP 1.0, Real and Integer have no width") {
  const Scenario scenario =
      read(ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors>"
                    "<ssd:Connector name='x' kind='output'><ssc:Real unit='m'/></ssd:Connector>"
                    "<ssd:Connector name='n' kind='output'><ssc:Integer/></ssd:Connector>"
                    "<ssd:Connector name='b' kind='output'><ssc:Boolean/></ssd:Connector>"
                    "</ssd:Connectors></ssd:Component>",
                    "", "1.0"));
  const auto& connectors = scenario.system.components[0].connectors;
  CHECK(connectors[0].type == std::nullopt);
  CHECK(connectors[0].unit.name == "m");
  CHECK(connectors[1].type == std::nullopt);
  CHECK(connectors[0].kin == ValueType::Float64);
  CHECK(connectors[1].kin == ValueType::Int32);
  CHECK(connectors[2].type == ValueType::Boolean);
  CHECK(connectors[2].kin == std::nullopt);
}

TEST_CASE("The prefixes of namespaces are free") {
  const Scenario scenario = read(
      "<SystemStructureDescription name='n' version='1.0' "
      "xmlns='http://ssp-standard.org/SSP1/SystemStructureDescription'><System name='s'>"
      "<Elements><Component name='a' source='a.fmu'><Connectors><Connector name='x' kind='input'>"
      "<q:Boolean xmlns:q='http://ssp-standard.org/SSP1/SystemStructureCommon'/>"
      "</Connector></Connectors></Component></Elements></System></SystemStructureDescription>");
  REQUIRE(scenario.system.components.size() == 1);
  CHECK(scenario.system.components[0].connectors[0].type == ValueType::Boolean);
}

TEST_CASE("The kinds of the connectors determine the direction of a value") {
  const auto connectors = [](const std::string& name, const std::string& kind) {
    return "<ssd:Component name='" + name + "' source='x.fmu'><ssd:Connectors><ssd:Connector " +
           "name='p' kind='" + kind + "'/></ssd:Connectors></ssd:Component>";
  };
  const std::string wire =
      "<ssd:Connections><ssd:Connection startElement='a' startConnector='p' endElement='b' "
      "endConnector='p'/></ssd:Connections>";
  const auto source = [&](const std::string& elements) {
    return read(ssd_with(elements, wire)).system.connections.at(0).from_component;
  };
  CHECK(source(connectors("a", "output") + connectors("b", "input")) == "a");
  CHECK(source(connectors("a", "input") + connectors("b", "output")) == "b");
  CHECK(source(connectors("a", "input") + connectors("b", "input")) == "a");
}

TEST_CASE("Another kind of file is recognised") {
  CHECK_THROWS_WITH(
      read("<v:ParameterSet "
           "xmlns:v='http://ssp-standard.org/SSP1/SystemStructureParameterValues'/>"),
      Contains("x.ssd:1: this is a parameter set (.ssv), expected a system structure description"));
  CHECK_THROWS_WITH(read("<fmiModelDescription/>"), Contains("the model description of an FMU"));
  CHECK_THROWS_WITH(read("<svg xmlns='s'/>"), Contains("with the root element <svg>"));
  CHECK_THROWS_WITH(read("<SystemStructureDescription xmlns='wrong'/>"),
                    Contains("of the namespace 'wrong'"));
}

TEST_CASE("An unknown major version is refused") {
  const std::string version = GENERATE("3.0", "10.0", "0.9", "SSP1");
  CHECK_THROWS_WITH(read(ssd("<ssd:System name='s'/>", version)),
                    Contains("x.ssd:2: the version '" + version + "' of <ssd:SystemStructure") &&
                        Contains("stride reads SSP 1.0 and 2.0"));
}

TEST_CASE("What is missing is reported") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {ssd(""), "x.ssd:2: <ssd:SystemStructureDescription> holds no <System>"},
      {ssd("<ssd:System name='s'/>"), "x.ssd:3: the system has no component"},
      {ssd_with(""), "the system has no component"},
      {ssd_with("<ssd:Component source='a.fmu'/>"),
       "x.ssd:5: <ssd:Component> needs the attribute 'name'"},
      {ssd_with("<ssd:Component name='a'/>"), "x.ssd:5: the component 'a' has no source"},
      {ssd_with(kComponent + "\n" + kComponent),
       "x.ssd:6: two components are named 'a'; the first is in line 5"},
      {ssd_with(kComponent,
                "<ssd:Connections><ssd:Connection startElement='a' endElement='a' "
                "endConnector='y'/></ssd:Connections>"),
       "x.ssd:7: <ssd:Connection> needs the attribute 'startConnector'"},
      {ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors><ssd:Connector "
                "name='x'/></ssd:Connectors></ssd:Component>"),
       "<ssd:Connector> needs the attribute 'kind'"},
  }));
  CHECK_THROWS_WITH(read(text), Contains(message));
}

TEST_CASE("What is misspelt is refused, and the right word suggested") {
  const auto [text, message, hint] = GENERATE(table<std::string, std::string, std::string>({
      {ssd_with("<ssd:Componnet name='a' source='a.fmu'/>"),
       "x.ssd:5: <ssd:Componnet> is not known in <ssd:Elements>", "did you mean 'Component'?"},
      {ssd_with("<ssd:Component name='a' sorce='a.fmu'/>"),
       "x.ssd:5: <ssd:Component> has no attribute 'sorce'", "did you mean 'source'?"},
      {ssd_with(
           kComponent,
           "<ssd:Connections><ssd:Connection startElement='a' startConnector='x' endElement='a' "
           "endConnector='y' suppressUnitConversions='true'/></ssd:Connections>"),
       "has no attribute 'suppressUnitConversions'", "did you mean 'suppressUnitConversion'?"},
      {ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors><ssd:Connector name='x' "
                "kind='output' type='Real'/></ssd:Connectors></ssd:Component>"),
       "<ssd:Connector> has no attribute 'type'", "its type is an element in it: <ssc:Real/>"},
      {ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors><ssd:Connector name='x' "
                "kind='ouput'/></ssd:Connectors></ssd:Component>"),
       "kind=\"ouput\" of <ssd:Connector>: expected one of input, output",
       "did you mean 'output'?"},
      {ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors><ssd:Connector name='x' "
                "kind='output'><ssc:Flot64/></ssd:Connector></ssd:Connectors></ssd:Component>"),
       "<ssc:Flot64> is not a type of a connector", "did you mean 'Float64'?"},
      {ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors><ssd:Connector name='x' "
                "kind='output'><ssd:Float64/></ssd:Connector></ssd:Connectors></ssd:Component>"),
       "<ssd:Float64> is not known in a connector", "SystemStructureCommon"},
      {ssd("<ssd:System name='s'/><ssd:DefaultExperimnet/>"),
       "<ssd:DefaultExperimnet> is not known", "did you mean 'DefaultExperiment'?"},
  }));
  CHECK_THROWS_WITH(read(text), Contains(message) && Contains(hint));
}

TEST_CASE("Connectors are checked on their own") {
  const auto connectors = [](const std::string& inside) {
    return ssd_with("<ssd:Component name='a' source='a.fmu'><ssd:Connectors>" + inside +
                    "</ssd:Connectors></ssd:Component>");
  };
  CHECK_THROWS_WITH(read(connectors("<ssd:Connector name='x' kind='input'/>\n"
                                    "<ssd:Connector name='x' kind='output'/>")),
                    Contains("x.ssd:6: two connectors are named 'x'; the first is in line 5"));
  CHECK_THROWS_WITH(read(connectors("<ssd:Connector name='x' kind='inout'/>")),
                    Contains("no variable of an FMU is of the kind 'inout'"));
  CHECK_THROWS_WITH(
      read(connectors(
          "<ssd:Connector name='x' kind='input'><ssc:Real/><ssc:Int8/></ssd:Connector>")),
      Contains("<ssc:Int8> is a second type of this connector"));
}

TEST_CASE("What SSP has and stride has not is refused, never passed over") {
  CHECK_THROWS_WITH(
      read(ssd_with("<ssd:Component name='a' source='a.x' type='text/x'/>")),
      Contains("x.ssd:5: this version of stride does not support components of the type 'text/x'"));
}

TEST_CASE("The results are named after the file, or the folder that it is in") {
  const TemporaryFolder folder;
  const auto file = folder.write("SystemStructure.ssd", ssd_with(kComponent));
  CHECK(stem(file) == "SystemStructure");
  CHECK(stem(folder / "") == file.parent_path().filename());
}

TEST_CASE("Start and stop time are exact and make sense") {
  const auto experiment = [](const std::string& attributes) {
    return "<ssd:System name='s'><ssd:Elements>" + kComponent +
           "</ssd:Elements></ssd:System>\n<ssd:DefaultExperiment " + attributes + "/>";
  };
  const Scenario none = read(ssd(experiment("")));
  CHECK(none.start == std::nullopt);
  CHECK(none.stop == std::nullopt);
  CHECK(read(ssd(experiment("stopTime='0.1'"))).stop == Time(std::chrono::milliseconds(100)));
  CHECK_THROWS_WITH(read(ssd(experiment("stopTime='soon'"))),
                    Contains("x.ssd:4: stopTime='soon' is not a number"));
  const Scenario before_zero = read(ssd(experiment("startTime='-1' stopTime='-0.5'")));
  CHECK(before_zero.start == Time(-std::chrono::seconds(1)));
  CHECK(before_zero.stop == Time(-std::chrono::milliseconds(500)));
  CHECK(read(ssd(experiment("stopTime='-1'"))).stop == Time(-std::chrono::seconds(1)));
  CHECK_THROWS_WITH(read(ssd(experiment("startTime='2' stopTime='1.5'"))),
                    Contains("the run would end at 1.5 s, before it starts (2 s)"));
  CHECK(read(ssd(experiment("startTime='2' stopTime='2'"))).stop == Time(std::chrono::seconds(2)));
}

TEST_CASE("a component for Model Exchange is read with a warning, since its FMU may have both") {
  const Scenario scenario =
      read(ssd_with("<ssd:Component name='a' source='a.fmu' implementation='ModelExchange'/>"));
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("x.ssd:5: ") && Contains("for 'ModelExchange'"));
}

TEST_CASE("a component of another type is an FMU if its source is one, with a warning") {
  const auto of_type = [](const std::string& attributes) {
    return read(ssd_with("<ssd:Component name='a' source='a.fmu' " + attributes + "/>")).warnings;
  };
  CHECK(of_type("type=''").empty());
  CHECK(of_type("type='Application/X-FMU-SharedLibrary'").empty());
  CHECK(of_type("implementation=''").empty());
  CHECK(of_type("implementation='cosimulation'").empty());
  const auto warnings = of_type("type='application/x-fmu'");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("x.ssd:5: type=\"application/x-fmu\"") &&
                              Contains("'application/x-fmu-sharedlibrary'"));
  CHECK_THROWS_WITH(
      read(ssd_with("<ssd:Component name='a' source='a.dll' type='application/x-dll'/>")),
      Contains("components of the type 'application/x-dll'"));
}

TEST_CASE("the experiment of a system may have a step, as that of an FMU has, and must be right") {
  const auto with = [](const std::string& attributes) {
    return read(ssd("<ssd:System name='s'><ssd:Elements>" + std::string(kComponent) +
                    "</ssd:Elements></ssd:System>\n<ssd:DefaultExperiment " + attributes + "/>"));
  };
  const Scenario scenario = with("stepSize='0.5' tolerance='1e-6'");
  REQUIRE(scenario.vendor_step);
  CHECK(scenario.vendor_step->size == std::chrono::milliseconds(500));
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("the tolerance of <ssd:DefaultExperiment> is ignored"));
  CHECK_THROWS_WITH(with("stepSize='0,5'"), Contains("stepSize='0,5' is not a number; expected"));
  CHECK_THROWS_WITH(with("stepSize='0'"), Contains("expected a number of seconds above 0"));
}

TEST_CASE("the fixed step of another tool is found in any of its annotations") {
  const std::string osp =
      "<ssd:DefaultExperiment><ssd:Annotations><ssc:Annotation type='com.opensimulationplatform'>"
      "<osp:Algorithm>\n<osp:FixedStepAlgorithm baseStepSize='1e-4'/></osp:Algorithm>"
      "</ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>";
  const std::string elements = "<ssd:Elements>" + kComponent + "</ssd:Elements>";
  const Scenario of_osp = read(ssd("<ssd:System name='s'>" + elements + "</ssd:System>" + osp));
  REQUIRE(of_osp.vendor_step);
  CHECK(of_osp.vendor_step->size == std::chrono::microseconds(100));
  CHECK(of_osp.vendor_step->tag == "<osp:FixedStepAlgorithm>");
  const std::string oms =
      "<ssd:Annotations><ssc:Annotation type='org.openmodelica'><oms:SimulationInformation>"
      "<oms:FixedStepMaster description='oms-ma' stepSize='0.001000'/>"
      "</oms:SimulationInformation></ssc:Annotation></ssd:Annotations>";
  const Scenario of_oms = read(ssd("<ssd:System name='s'>" + elements + oms + "</ssd:System>"));
  REQUIRE(of_oms.vendor_step);
  CHECK(of_oms.vendor_step->size == std::chrono::milliseconds(1));
  const std::string none =
      "<ssd:Annotations><ssc:Annotation type='x'><a:FixedStepMaster "
      "stepSize='-1'/></ssc:Annotation></ssd:Annotations>";
  CHECK_FALSE(read(ssd("<ssd:System name='s'>" + elements + none + "</ssd:System>")).vendor_step);
}
