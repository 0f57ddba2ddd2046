#include "master/fmi/model_description.h"

#include "tests/master/fmi/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using core::Causality;
using core::ValueType;
using core::Variability;

namespace {

constexpr const char* kComplete = R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Tank 2" instantiationToken="{8c4e810f}"
    description="A tank" generationTool="a tool" variableNamingConvention="structured">
  <ModelExchange modelIdentifier="tank_me"/>
  <CoSimulation modelIdentifier="tank" canGetAndSetFMUState="true" canSerializeFMUState="1"
      canHandleVariableCommunicationStepSize="true" fixedInternalStepSize="1e-3"
      maxOutputDerivativeOrder="2" mightReturnEarlyFromDoStep="true" hasEventMode="true"
      canBeInstantiatedOnlyOncePerProcess="true" needsExecutionTool="true"/>
  <UnitDefinitions>
    <Unit name="degC"><BaseUnit K="1" offset="273.15"/></Unit>
    <Unit name="mm/s"><BaseUnit m="1" s="-1" factor="0.001"/></Unit>
    <Unit name="furlong"/>
  </UnitDefinitions>
  <TypeDefinitions>
    <Float64Type name="Temperature" unit="degC" min="-273.15" max="1000"/>
    <EnumerationType name="Mode"><Item name="off" value="0"/><Item name="on" value="7"/></EnumerationType>
    <ClockType name="Tick" intervalVariability="triggered"/>
  </TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="12.5" stepSize="0.01"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent"/>
    <UInt64 name="rows" valueReference="1" causality="structuralParameter" start=" 2"/>
    <Float64 name="field" valueReference="2" causality="output" initial="calculated">
      <Dimension valueReference="1"/><Dimension start="3"/></Float64>
    <Float64 name="temperature" valueReference="3" causality="input" declaredType="Temperature"
        max="100" start="20"/>
    <Enumeration name="mode" valueReference="4" causality="parameter" declaredType="Mode" start="7"
        variability="tunable"/>
    <Clock name="tick" valueReference="5" causality="input" declaredType="Tick"/>
    <Binary name="frame" valueReference="6" causality="input" clocks="5"><Start value="00ff"/></Binary>
    <String name="words" valueReference="7" causality="parameter">
      <Dimension start="2"/><Start value="one"/><Start value="two"/></String>
    <Boolean name="on" valueReference="8"/>
    <Float32 name="level" valueReference="9" causality="output" unit="mm/s" description="how high">
      <Alias name="height"/></Float32>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="2" dependencies="3 4"/>
    <Output valueReference="9"/>
    <InitialUnknown valueReference="2" dependencies=""/>
  </ModelStructure>
</fmiModelDescription>)";

const core::Variable& variable(const core::UnitDescription& unit, const std::string& name) {
  const auto place = unit.find(name);
  REQUIRE(place);
  return unit.variables[*place];
}

/// The complaint about the complete description after one change to its text.
std::string error_with(const std::string& from, const std::string& to) {
  std::string text = kComplete;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  CAPTURE(from, to);
  return input_error([&] { fmi::parse_model_description(text, "unit.xml"); });
}

}  // namespace

TEST_CASE("the unit as a whole") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  CHECK(unit.fmi_version == "3.0");
  CHECK(unit.model_name == "Tank 2");
  CHECK(unit.model_identifier == "tank");
  CHECK(unit.instantiation_token == "{8c4e810f}");
  CHECK(unit.description == "A tank");
  CHECK(unit.generation_tool == "a tool");
  CHECK(unit.has_event_mode);
  CHECK(unit.can_save_state);
  CHECK(unit.can_serialize_state);
  CHECK(unit.can_vary_step);
  CHECK(unit.may_return_early);
  CHECK(unit.single_instance);
  CHECK(unit.needs_execution_tool);
  CHECK(unit.max_output_derivative_order == 2);
  CHECK(unit.fixed_internal_step == 1e-3);
  CHECK(unit.default_step == 0.01);
  CHECK(unit.default_stop == 12.5);
}

TEST_CASE("capabilities are absent unless they are declared") {
  const auto unit = fmi::parse_model_description(description_text("x", ""), "unit.xml");
  CHECK_FALSE(unit.has_event_mode);
  CHECK_FALSE(unit.can_save_state);
  CHECK_FALSE(unit.can_vary_step);
  CHECK_FALSE(unit.may_return_early);
  CHECK_FALSE(unit.single_instance);
  CHECK(unit.max_output_derivative_order == 0);
  CHECK_FALSE(unit.fixed_internal_step);
  CHECK_FALSE(unit.default_step);
}

TEST_CASE("units of measurement whose meaning is given") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  REQUIRE(unit.units.size() == 2);
  CHECK(unit.units.at("degC").exponents == std::array<int, 8>{0, 0, 0, 0, 1, 0, 0, 0});
  CHECK(unit.units.at("degC").offset == 273.15);
  CHECK(unit.units.at("mm/s").exponents == std::array<int, 8>{0, 1, -1, 0, 0, 0, 0, 0});
  CHECK(unit.units.at("mm/s").factor == 0.001);
}

TEST_CASE("variables keep their order, and their defaults are those of the standard") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  REQUIRE(unit.variables.size() == 10);
  CHECK(unit.variables[0].name == "time");
  CHECK(unit.variables[0].causality == Causality::Independent);
  CHECK(unit.variables[0].variability == Variability::Continuous);
  CHECK(variable(unit, "rows").variability == Variability::Fixed);
  CHECK(variable(unit, "mode").variability == Variability::Tunable);
  CHECK(variable(unit, "frame").variability == Variability::Discrete);
  CHECK(variable(unit, "on").causality == Causality::Local);
  CHECK(variable(unit, "on").variability == Variability::Discrete);
  CHECK(variable(unit, "level").type == ValueType::Float32);
  CHECK(variable(unit, "level").unit == "mm/s");
  CHECK(variable(unit, "level").description == "how high");
}

TEST_CASE("dimensions are fixed numbers or the start of a structural parameter") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "field").dimensions == std::vector<std::size_t>{2, 3});
  CHECK(variable(unit, "field").size == 6);
  CHECK(variable(unit, "rows").size == 1);
}

TEST_CASE("a declared type gives what the variable leaves open") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "temperature").unit == "degC");
  CHECK(variable(unit, "temperature").min == "-273.15");
  CHECK(variable(unit, "temperature").max == "100");
  CHECK(variable(unit, "tick").interval_variability == "triggered");
  using Items = std::vector<std::pair<std::string, std::int64_t>>;
  CHECK(variable(unit, "mode").items == Items{{"off", 0}, {"on", 7}});
}

TEST_CASE("start values and clocks") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "temperature").start == "20");
  CHECK(variable(unit, "words").start == "one two");
  CHECK(variable(unit, "frame").start == "00ff");
  CHECK(variable(unit, "frame").clocks == std::vector<core::ValueReference>{5});
}

TEST_CASE("no dependencies said and none at all are not the same") {
  const auto unit = fmi::parse_model_description(kComplete, "unit.xml");
  REQUIRE(unit.outputs.size() == 2);
  CHECK(unit.outputs[0].dependencies == std::vector<core::ValueReference>{3, 4});
  CHECK_FALSE(unit.outputs[1].dependencies);
  REQUIRE(unit.initial_unknowns.size() == 1);
  CHECK(unit.initial_unknowns[0].dependencies == std::vector<core::ValueReference>{});
}

TEST_CASE("other versions of FMI are named") {
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", "fmiVersion=\"2.0\""),
             Contains("unit.xml:2: FMI 2.0 units are not supported yet"));
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", "fmiVersion=\"1.0\""), Contains("\"1.0\""));
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", ""), Contains("no attribute 'fmiVersion'"));
  CHECK_THAT(input_error([] { fmi::parse_model_description("<html/>", "unit.xml"); }),
             Contains("the document is a <html>"));
  std::string text = kComplete;
  text.replace(text.find("3.0"), 3, "3.1");
  CHECK(fmi::parse_model_description(text, "unit.xml").fmi_version == "3.1");
}

TEST_CASE("a unit without Co-Simulation says what it has") {
  const std::string text = R"(<fmiModelDescription fmiVersion="3.0" modelName="x"
    instantiationToken="x"><ModelExchange modelIdentifier="x"/><ScheduledExecution
    modelIdentifier="x"/></fmiModelDescription>)";
  CHECK_THAT(input_error([&] { fmi::parse_model_description(text, "unit.xml"); }),
             Contains("no Co-Simulation interface") &&
                 Contains("it has ModelExchange, ScheduledExecution"));
}

TEST_CASE("broken documents") {
  CHECK_THAT(error_with("</ModelVariables>", "</ModelVariable>"),
             Contains("unit.xml:") && Contains("not well-formed: mismatched element"));
  CHECK_THAT(input_error([] { fmi::parse_model_description("", "unit.xml"); }),
             Contains("not well-formed: empty document"));
  CHECK_THAT(error_with("<ModelVariables>", "<Other>"), Contains("not well-formed"));
  CHECK_THAT(input_error([] { fmi::read_model_description("/absent.xml", "shown.xml"); }),
             Contains("shown.xml: the model description cannot be read"));
}

TEST_CASE("missing parts and wrong values are errors with their line") {
  CHECK_THAT(error_with("instantiationToken=\"{8c4e810f}\"", ""),
             Contains("unit.xml:2: ") && Contains("'instantiationToken'"));
  CHECK_THAT(error_with("modelIdentifier=\"tank\"", ""),
             Contains("unit.xml:5: ") && Contains("'modelIdentifier'"));
  CHECK_THAT(error_with("modelIdentifier=\"tank\"", "modelIdentifier=\"../../tank\""),
             Contains("expected the plain name"));
  CHECK_THAT(error_with("hasEventMode=\"true\"", "hasEventMode=\"yes\""),
             Contains("expected true or false"));
  CHECK_THAT(error_with("name=\"level\"", ""), Contains("unit.xml:34: ") && Contains("'name'"));
  CHECK_THAT(error_with("valueReference=\"9\"", ""), Contains("'valueReference'"));
  CHECK_THAT(error_with("valueReference=\"9\"", "valueReference=\"-9\""),
             Contains("expected an integer"));
  CHECK_THAT(error_with("<Boolean name", "<Bool name"), Contains("<Bool> is no type of FMI 3.0"));
  CHECK_THAT(error_with("causality=\"input\"", "causality=\"inward\""),
             Contains("expected one of parameter, "));
  CHECK_THAT(error_with("variability=\"tunable\"", "variability=\"often\""),
             Contains("expected one of constant, "));
  CHECK_THAT(error_with("factor=\"0.001\"", "factor=\"0\""), Contains("cannot be zero"));
}

TEST_CASE("names and value references are unique") {
  CHECK_THAT(error_with("name=\"level\"", "name=\"on\""),
             Contains("unit.xml:34: ") && Contains("'on' is used twice, first in line 33"));
  CHECK_THAT(error_with("valueReference=\"9\" causality", "valueReference=\"8\" causality"),
             Contains("variable 'level' has the value reference 8 of 'on' in line 33"));
}

TEST_CASE("references lead somewhere") {
  CHECK_THAT(error_with("clocks=\"5\"", "clocks=\"55\""),
             Contains("'frame' belongs to the clock 55, which does not exist"));
  CHECK_THAT(error_with("clocks=\"5\"", "clocks=\"4\""),
             Contains("'mode' has the type Enumeration"));
  CHECK_THAT(error_with("<Dimension valueReference=\"1\"/>", "<Dimension valueReference=\"3\"/>"),
             Contains("not that of a structural parameter"));
  CHECK_THAT(error_with("<Dimension valueReference=\"1\"/>", "<Dimension/>"),
             Contains("needs 'start' or 'valueReference'"));
  CHECK_THAT(error_with("start=\" 2\"", "start=\"many\""),
             Contains("'rows' has the start value 'many'"));
  CHECK_THAT(error_with("<Output valueReference=\"9\"/>", "<Output valueReference=\"99\"/>"),
             Contains("<Output> refers to the value reference 99"));
  CHECK_THAT(error_with("dependencies=\"3 4\"", "dependencies=\"3 44\""), Contains("44"));
  CHECK_THAT(error_with("declaredType=\"Temperature\"", "declaredType=\"Heat\""),
             Contains("no such type"));
  CHECK_THAT(error_with("declaredType=\"Temperature\"", "declaredType=\"Mode\""),
             Contains("is a <EnumerationType>; expected a <Float64Type>"));
  CHECK_THAT(error_with("declaredType=\"Mode\"", ""), Contains("'declaredType'"));
  CHECK_THAT(error_with("declaredType=\"Tick\"", ""), Contains("'intervalVariability'"));
}

TEST_CASE("a description cannot ask for more elements than memory holds") {
  CHECK_THAT(error_with("<Dimension start=\"3\"/>", "<Dimension start=\"4294967296\"/>"),
             Contains("variable 'field' has more than"));
  CHECK_THAT(error_with("<Dimension start=\"3\"/>",
                        "<Dimension start=\"100000\"/><Dimension start=\"100000\"/>"),
             Contains("variable 'field' has more than"));
}
