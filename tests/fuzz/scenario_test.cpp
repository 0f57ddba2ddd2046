// Whatever a file holds, reading it gives a scenario or a core::Error, completing what was read
// gives a text that reads back, and so does packing it.
#include "master/scenario/scenario.h"

#include <filesystem>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>

#include "master/ssp/complete.h"
#include "master/ssp/package.h"
#include "master/util/archive/zip.h"
#include "master/util/error.h"
#include "tests/fuzz/mutator.h"
#include "tests/master/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;

namespace {

const std::string kScenario = ssd(R"(<ssd:System name="root" description="&lt;&#x41;&amp;">
  <ssd:ParameterBindings>
    <ssd:ParameterBinding prefix="a."><ssd:ParameterValues>
      <ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>
        <ssv:Parameter name="gain"><ssv:Real value="1.5" unit="m"/></ssv:Parameter>
        <ssv:Parameter name="w"><ssv:String><ssv:Value value="x"/></ssv:String></ssv:Parameter>
      </ssv:Parameters></ssv:ParameterSet>
    </ssd:ParameterValues></ssd:ParameterBinding>
  </ssd:ParameterBindings>
  <ssd:Elements><!-- two -->
    <ssd:Component name="a" source="units/a%20b.fmu"><ssd:Connectors>
      <ssd:Connector name="distance" kind="output"><ssc:Float64 unit="m"/></ssd:Connector>
    </ssd:Connectors></ssd:Component>
    <ssd:Component name="b" source="file:///b.fmu"/>
    <ssd:System name="s" id="s1">
      <ssd:Connectors><ssd:Connector name="u" kind="input"><ssc:Real unit="m"/></ssd:Connector>
        <ssd:Connector name="y" kind="output"/></ssd:Connectors>
      <ssd:Elements><ssd:Component name="c" source="c.fmu"/>
        <ssd:SignalDictionaryReference name="r" dictionary="d"/></ssd:Elements>
      <ssd:Connections>
        <ssd:Connection startConnector="u" endElement="c" endConnector="u">
          <ssc:LinearTransformation factor="2" offset="-1e3"/></ssd:Connection>
        <ssd:Connection startElement="c" startConnector="y" endConnector="y"/>
        <ssd:Connection startElement="c" startConnector="m" endElement="r" endConnector="e">
          <ssc:IntegerMappingTransformation><ssc:MapEntry source="1" target="2"/>
          </ssc:IntegerMappingTransformation></ssd:Connection>
      </ssd:Connections>
      <ssd:SignalDictionaries><ssd:SignalDictionary name="d"><ssb:SignalDictionary version="2.0"
        xmlns:ssb="http://ssp-standard.org/SSP1/SystemStructureSignalDictionary">
        <ssb:DictionaryEntry name="e"><ssc:Enumeration name="E"/></ssb:DictionaryEntry>
      </ssb:SignalDictionary></ssd:SignalDictionary></ssd:SignalDictionaries>
    </ssd:System>
    <ssd:Component name="t" source="#s1" type="application/x-ssp-definition"/>
  </ssd:Elements>
  <ssd:Connections>
    <ssd:Connection startElement="a" startConnector="x" endElement="s" endConnector="u"/>
    <ssd:Connection startElement="a" startConnector="x" endElement="b" endConnector="y"
                    suppressUnitConversion="true"/>
  </ssd:Connections>
</ssd:System>
<ssd:Enumerations><ssc:Enumeration name="E"><ssc:Item name="i" value="1"/></ssc:Enumeration>
</ssd:Enumerations>
<ssd:Units><ssc:Unit name="m"><ssc:BaseUnit m="1" factor="1"/></ssc:Unit></ssd:Units>
<ssd:DefaultExperiment startTime="0" stopTime="30.5e0"/>
<ssd:Annotations><ssc:Annotation type="org.stride">
  <stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    <stride:Step size="0.001"/><stride:Record signals="a.* b.x"/><stride:Results trace="none"/>
    <stride:Checks><stride:Always name="n" signal="a.x" min="0" max="1e3" from="1" to="2.5"/>
      <stride:Final signal="b.y" equals="3" tolerance="0.1"/>
      <stride:Count event="a.m" min="1" max="18446744073709551615"/>
      <stride:Answer request="a.m" reply="b.m" within="1e-3" repeats="true"/></stride:Checks>
  </stride:Scenario>
</ssc:Annotation></ssd:Annotations>)");

const std::string kMapping = R"(<ssm:ParameterMapping version="1.0"
    xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssm:MappingEntry source="x" target="a.u" suppressUnitConversion="true">
    <ssc:LinearTransformation factor="2" offset="1"/>
  </ssm:MappingEntry>
  <ssm:MappingEntry source="n" target="a.m"><ssc:EnumerationMappingTransformation>
    <ssc:MapEntry source="on" target="go"/></ssc:EnumerationMappingTransformation>
  </ssm:MappingEntry>
</ssm:ParameterMapping>)";

const std::string kMapped = ssd(R"(<ssd:System name="root">
  <ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>
    <ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>
      <ssv:Parameter name="x"><ssv:Real value="1"/></ssv:Parameter>
      <ssv:Parameter name="n"><ssv:Enumeration value="on"/></ssv:Parameter>
    </ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>
    <ssd:ParameterMapping source="map.ssm"/></ssd:ParameterBinding></ssd:ParameterBindings>
  <ssd:Elements><ssd:Component name="a" source="a.fmu"/></ssd:Elements></ssd:System>)");

/// Reads each of many damaged files, and returns how many of them were read.
template <class Write>
int count_read(int times, Write&& write) {
  int read = 0;
  for (int i = 0; i < times; ++i) {
    try {
      read_scenario(write());
      ++read;
    } catch (const core::Error& error) {
      CHECK(error.kind() == core::Error::Kind::Input);
    }
  }
  return read;
}

}  // namespace

TEST_CASE("A mutated mapping is read or refused") {
  const TemporaryFolder folder;
  tests::Mutator mutator(7);
  const auto scenario = folder.write("x.ssd", kMapped);
  folder.write("map.ssm", kMapping);
  REQUIRE(read_scenario(scenario).system.start_values.size() == 2);
  const int read = count_read(2000, [&] {
    folder.write("map.ssm", mutator.mutate(kMapping));
    return scenario;
  });
  CHECK(read > 10);
  CHECK(read < 1000);
}

TEST_CASE("A mutated package is read or refused, and nothing is written outside") {
  const TemporaryFolder folder;
  tests::Mutator mutator(8, std::string("PK\x01\x02\x03\x04/.\0", 9));
  archive::write_zip(folder / "x.ssp", {{"SystemStructure.ssd", {kMapped, {}, false}},
                                        {"map.ssm", {kMapping, {}, false}}});
  const std::string package = content(folder / "x.ssp");
  REQUIRE_NOTHROW(read_scenario(folder / "x.ssp"));
  const int read = count_read(500, [&] { return folder.write("x.ssp", mutator.mutate(package)); });
  CHECK(read < 400);
  CHECK(std::distance(std::filesystem::directory_iterator(folder / ""), {}) == 1);
}

TEST_CASE("A mutated scenario is read or refused, and never anything else") {
  const TemporaryFolder folder;
  tests::Mutator mutator(20240117);
  const Descriptions descriptions{{"a", sample_description()}, {"b", sample_description()}};
  REQUIRE_NOTHROW(read_scenario(folder.write("x.ssd", kScenario)));
  int read = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto file = folder.write("x.ssd", mutator.mutate(kScenario));
    try {
      const Scenario scenario = read_scenario(file);
      ++read;
      Descriptions known;
      for (const auto& component : scenario.system.components) {
        known.emplace(component.name, descriptions.at("a"));
      }
      const std::string completed = complete(file, known);
      INFO(completed);
      CHECK(complete(folder.write("x.ssd", completed), known) == completed);
      Files files;
      try {
        package_contents(file, files, [&](const auto&, const auto&) { return file; });
      } catch (const core::Error& error) {
        CHECK(error.kind() == core::Error::Kind::Input);
      }
    } catch (const core::Error& error) {
      ++refused;
      CHECK(error.kind() == core::Error::Kind::Input);
      CHECK(error.context().where.file == file.string());
    }
  }
  CHECK(read > 50);
  CHECK(refused > 2000);
}
