// Whatever a file holds, reading it gives a scenario or a core::Error, and completing what was read
// gives a text that reads back.
#include <string>

#include <catch2/catch.hpp>

#include "master/core/error.h"
#include "master/io/complete.h"
#include "master/io/scenario.h"
#include "tests/fuzz/mutator.h"
#include "tests/master/io/support.h"

using namespace stride;
using namespace stride::io;

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
  </ssd:Elements>
  <ssd:Connections>
    <ssd:Connection startElement="a" startConnector="x" endElement="b" endConnector="y"
                    suppressUnitConversion="true"/>
  </ssd:Connections>
</ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="30.5e0"/>
<ssd:Annotations><ssc:Annotation type="org.stride">
  <stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    <stride:Step size="0.001"/><stride:Record signals="a.* b.x"/><stride:Results trace="none"/>
  </stride:Scenario>
</ssc:Annotation></ssd:Annotations>)");

}  // namespace

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
    } catch (const core::Error& error) {
      ++refused;
      CHECK(error.kind() == core::Error::Kind::Input);
      CHECK(error.context().where.file == file.string());
    }
  }
  CHECK(read > 50);
  CHECK(refused > 2000);
}
