#include "master/system/ssp/complete.h"

#include <catch2/catch.hpp>

#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

Descriptions descriptions() { return {{"a", sample_description()}, {"b", sample_description()}}; }

std::string completed(const std::string& text) {
  const TemporaryFolder folder;
  return complete(folder.write("x.ssd", text), descriptions());
}

/// Whether the lines of the original are all in the text, in their order.
bool keeps_each_line(const std::string& original, const std::string& text) {
  std::istringstream lines(original);
  std::size_t at = 0;
  for (std::string line; std::getline(lines, line);) {
    at = text.find(line, at);
    if (at == std::string::npos) return false;
    at += line.size();
  }
  return true;
}

const std::string kText = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- a comment at the top -->
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
                                version="2.0"   name="test">
  <ssd:System name="root">
    <ssd:Elements>
      <ssd:Component name="a" source="a.fmu">
      </ssd:Component>
      <ssd:Component name="b" source="b.fmu">
        <ssd:Connectors>
          <ssd:Connector kind="output" name="distance"/>   <!-- mine -->
        </ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
  </ssd:System>

  <ssd:DefaultExperiment stopTime="1"/>
</ssd:SystemStructureDescription>
)";

}  // namespace

TEST_CASE("A completed scenario declares all inputs and outputs, and nothing else changes") {
  const std::string text = completed(kText);
  CHECK(text == R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- a comment at the top -->
<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
                                version="2.0"   name="test" xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="root">
    <ssd:Elements>
      <ssd:Component name="a" source="a.fmu">
        <ssd:Connectors>
          <ssd:Connector name="distance" kind="output"><ssc:Float64 unit="m"/></ssd:Connector>
          <ssd:Connector name="led" kind="output"><ssc:Boolean/></ssd:Connector>
          <ssd:Connector name="frames.count" kind="output"><ssc:Int32/></ssd:Connector>
          <ssd:Connector name="position" kind="output"><ssc:Float64 unit="m"/><ssc:Dimension size="3"/></ssd:Connector>
          <ssd:Connector name="label" kind="output"><ssc:String/></ssd:Connector>
          <ssd:Connector name="digest" kind="output"><ssc:Binary/></ssd:Connector>
          <ssd:Connector name="transmit.clock" kind="output"><ssc:Clock intervalVariability="triggered"/></ssd:Connector>
          <ssd:Connector name="transmit.frame" kind="output"><ssc:Binary/><ssd:Clock name="transmit.clock"/></ssd:Connector>
          <ssd:Connector name="tick" kind="output"><ssc:Clock intervalVariability="triggered"/></ssd:Connector>
          <ssd:Connector name="temperature" kind="input"><ssc:Float64 unit="degC"/></ssd:Connector>
          <ssd:Connector name="mode" kind="output"><ssc:Enumeration name="a.mode"/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
      <ssd:Component name="b" source="b.fmu">
        <ssd:Connectors>
          <ssd:Connector kind="output" name="distance"/>   <!-- mine -->
          <ssd:Connector name="led" kind="output"><ssc:Boolean/></ssd:Connector>
          <ssd:Connector name="frames.count" kind="output"><ssc:Int32/></ssd:Connector>
          <ssd:Connector name="position" kind="output"><ssc:Float64 unit="m"/><ssc:Dimension size="3"/></ssd:Connector>
          <ssd:Connector name="label" kind="output"><ssc:String/></ssd:Connector>
          <ssd:Connector name="digest" kind="output"><ssc:Binary/></ssd:Connector>
          <ssd:Connector name="transmit.clock" kind="output"><ssc:Clock intervalVariability="triggered"/></ssd:Connector>
          <ssd:Connector name="transmit.frame" kind="output"><ssc:Binary/><ssd:Clock name="transmit.clock"/></ssd:Connector>
          <ssd:Connector name="tick" kind="output"><ssc:Clock intervalVariability="triggered"/></ssd:Connector>
          <ssd:Connector name="temperature" kind="input"><ssc:Float64 unit="degC"/></ssd:Connector>
          <ssd:Connector name="mode" kind="output"><ssc:Enumeration name="b.mode"/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
  </ssd:System>
  <ssd:Enumerations>
    <ssc:Enumeration name="a.mode">
      <ssc:Item name="off" value="1"/>
      <ssc:Item name="on &lt;&amp;&gt;" value="2"/>
    </ssc:Enumeration>
    <ssc:Enumeration name="b.mode">
      <ssc:Item name="off" value="1"/>
      <ssc:Item name="on &lt;&amp;&gt;" value="2"/>
    </ssc:Enumeration>
  </ssd:Enumerations>
  <ssd:Units>
    <ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit>
    <ssc:Unit name="degC"><ssc:BaseUnit K="1" offset="273.15"/></ssc:Unit>
  </ssd:Units>

  <ssd:DefaultExperiment stopTime="1"/>
</ssd:SystemStructureDescription>
)");
}

TEST_CASE("Completing twice changes nothing") {
  const std::string once = completed(kText);
  CHECK(completed(once) == once);
}

TEST_CASE("What was completed is read back as the units declare it") {
  const TemporaryFolder folder;
  Scenario scenario = read_scenario(folder.write("x.ssd", completed(kText)));
  for (auto& component : scenario.system.components) {
    CHECK(component.connectors.size() == 11);
    component.description = sample_description();
  }
  CHECK_NOTHROW(core::System(scenario.system));
}

TEST_CASE("Lists that exist are added to, and other text is kept") {
  const std::string text = ssd(R"(	<ssd:System name="root">
		<ssd:Elements>
			<ssd:Component name="a" source="a.fmu" />
			<ssd:Component name='b' source='b.fmu'><!-- one --></ssd:Component>
		</ssd:Elements>
	</ssd:System>
	<ssd:Enumerations>
		<ssc:Enumeration name="a.mode"><ssc:Item name="x" value="1"/></ssc:Enumeration>
	</ssd:Enumerations>
	<ssd:Units>
		<ssc:Unit name="m"><ssc:BaseUnit m="1" factor="1.0"/></ssc:Unit>
		<ssc:Unit name="degC"><ssc:BaseUnit K="1"/></ssc:Unit>
	</ssd:Units>)");
  const std::string result = completed(text);
  CHECK(result.find("\t\t\t<ssd:Component name=\"a\" source=\"a.fmu\">\n\t\t\t\t<ssd:Connectors>\n"
                    "\t\t\t\t\t<ssd:Connector name=\"distance\"") != std::string::npos);
  CHECK(result.find("<!-- one --></ssd:Component>") != std::string::npos);
  CHECK(result.find("<ssc:Float64 unit=\"m\"/>") != std::string::npos);
  // the file's degC is another one, so the unit's own holds
  CHECK(result.find("name=\"temperature\" kind=\"input\"><ssc:Float64/>") != std::string::npos);
  CHECK(result.find("<ssc:Enumeration name=\"b.mode\">") != std::string::npos);
  CHECK(result.find("<ssd:Units>") == result.rfind("<ssd:Units>"));
  CHECK(completed(result) == result);
}

TEST_CASE("A file of SSP 1.0 gets the types of 1.0, and has no clocks") {
  const TemporaryFolder folder;
  const auto file =
      folder.write("x.ssd", ssd_with("<ssd:Component name='a' source='a.fmu'/>", "", "1.0"));
  auto description = std::make_shared<core::UnitDescription>(*sample_description());
  CHECK_THROWS_WITH(complete(file, {{"a", description}}),
                    Contains("x.ssd:5: SSP 1.0 has no clocks, so 'a.transmit.clock'") &&
                        Contains("version=\"2.0\""));
  auto& variables = description->variables;
  variables.erase(variables.begin() + 7, variables.begin() + 10);
  const std::string text = complete(file, {{"a", description}});
  CHECK(text.find("name=\"distance\" kind=\"output\"><ssc:Real unit=\"m\"/>") != std::string::npos);
  CHECK(text.find("name=\"frames.count\" kind=\"output\"><ssc:Integer/>") != std::string::npos);
  CHECK(text.find("Dimension") == std::string::npos);
}

TEST_CASE("Completion keeps each line of the original") {
  CHECK(keeps_each_line(ssd_with("<ssd:Component name='a' source='a.fmu'>\n<!-- c -->\n\n"
                                 "</ssd:Component>"),
                        completed(ssd_with("<ssd:Component name='a' source='a.fmu'>\n<!-- c -->\n\n"
                                           "</ssd:Component>"))));
}

TEST_CASE("A broken file is refused as by the reader") {
  CHECK_THROWS_WITH(completed(ssd("")), Contains("holds no <System>"));
}

TEST_CASE("further connections are added where they are missing, in the outermost system") {
  const TemporaryFolder folder;
  std::vector<ConnectionDeclaration> connections(2);
  connections[0].from_component = "a";
  connections[0].from_connector = "distance";
  connections[0].to_component = "b";
  connections[0].to_connector = "a \"limit\"";
  connections[1] = connections[0];
  connections[1].from_component = "cell.a";
  const auto add = [&](const std::string& text) {
    return complete(folder.write("x.ssd", text), descriptions(), "", connections);
  };
  const std::string text = add(kText);
  CHECK_THAT(text, Contains("    </ssd:Elements>\n    <ssd:Connections>\n      <ssd:Connection "
                            "startElement=\"a\" startConnector=\"distance\" endElement=\"b\" "
                            "endConnector=\"a &quot;limit&quot;\"/>\n    </ssd:Connections>\n"));
  CHECK_THAT(text, !Contains("cell.a"));
  CHECK(add(text) == text);
}

TEST_CASE("a system that is used more than once is completed, without the sizes that differ") {
  const auto of_size = [](std::size_t size) {
    auto description = std::make_shared<core::UnitDescription>();
    description->variables.push_back(variable("y", 1, ValueType::Float64));
    description->variables.push_back(variable("z", 2, ValueType::Float64));
    for (core::Variable& array : description->variables) array.dimensions = {3};
    description->variables[0].dimensions = {size};
    return description;
  };
  const std::string text = ssd_with(
      "<ssd:System name='s' id='s'><ssd:Elements><ssd:Component name='c' source='c.fmu'/>"
      "</ssd:Elements></ssd:System>\n<ssd:Component name='t' source='#s'/>");
  const TemporaryFolder folder;
  const auto file = folder.write("x.ssd", text);
  const auto with = [&](std::size_t second) {
    return complete(file, {{"s.c", of_size(2)}, {"t.c", of_size(second)}});
  };
  CHECK_THAT(with(2), Contains("<ssd:Connector name=\"y\" kind=\"output\"><ssc:Float64/>"
                               "<ssc:Dimension size=\"2\"/></ssd:Connector>"));
  CHECK_THAT(with(4), Contains("<ssd:Connector name=\"y\" kind=\"output\"><ssc:Float64/>"
                               "</ssd:Connector>") &&
                          Contains("<ssd:Connector name=\"z\" kind=\"output\"><ssc:Float64/>"
                                   "<ssc:Dimension size=\"3\"/></ssd:Connector>"));
}

TEST_CASE("each unit of measure that a connector names is defined, where it is known") {
  auto description = std::make_shared<core::UnitDescription>(*sample_description());
  description->units_of_measure.clear();
  description->units_of_measure["furlong"] = {{0, 1, 0, 0, 0, 0, 0, 0}, 201.168L, 0};
  description->variables[1].unit = "km/h";
  description->variables[4].unit = "sack";
  const TemporaryFolder folder;
  const std::string connector =
      "<ssd:Connectors><ssd:Connector name='led' kind='output'><ssc:Boolean/></ssd:Connector>"
      "<ssd:Connector name='way' kind='output'><ssc:Float64 unit='furlong'/></ssd:Connector>"
      "</ssd:Connectors>";
  const std::string text =
      ssd("<ssd:System name='root'><ssd:Connectors><ssd:Connector name='out' kind='output'>"
          "<ssc:Float64 unit='rpm'/></ssd:Connector></ssd:Connectors><ssd:Elements>"
          "<ssd:Component name='a' source='a.fmu'>" +
          connector + "</ssd:Component></ssd:Elements></ssd:System>");
  const std::string once = complete(folder.write("x.ssd", text), {{"a", description}});
  CHECK_THAT(once, Contains("<ssc:Float64 unit=\"km/h\"/>") &&
                       Contains("<ssc:Unit name=\"km/h\"><ssc:BaseUnit m=\"1\" s=\"-1\" "
                                "factor=\"0.2777777777777778\"/>") &&
                       Contains("<ssc:Unit name=\"furlong\"><ssc:BaseUnit m=\"1\" "
                                "factor=\"201.168\"/>") &&
                       Contains("<ssc:Unit name=\"rpm\">") &&
                       Contains("<ssc:Unit name=\"degC\">") && !Contains("sack"));
  CHECK(complete(folder.write("x.ssd", once), {{"a", description}}) == once);
}
