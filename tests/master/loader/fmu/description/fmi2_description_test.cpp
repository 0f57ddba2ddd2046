#include "master/loader/fmu/description/fmi2_description.h"

#include "master/engine/model/values.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::Causality;
using core::Initial;
using core::ValueType;
using core::Variability;

namespace {

constexpr const char* kTank = R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Tank 2" guid="{8c4e810f}" description="A tank"
    generationTool="a tool" numberOfEventIndicators="2" variableNamingConvention="structured">
  <ModelExchange modelIdentifier="tank_me"/>
  <CoSimulation modelIdentifier="tank" needsExecutionTool="true" canInterpolateInputs="true"
      canHandleVariableCommunicationStepSize="true" maxOutputDerivativeOrder="3"
      canRunAsynchronuously="true" canBeInstantiatedOnlyOncePerProcess="true"
      canNotUseMemoryManagementFunctions="true" canGetAndSetFMUstate="true"
      canSerializeFMUstate="1" providesDirectionalDerivative="true">
    <SourceFiles><File name="tank.c"/></SourceFiles>
  </CoSimulation>
  <UnitDefinitions>
    <Unit name="degC"><BaseUnit K="1" offset="273.15"/><DisplayUnit name="K"/></Unit>
    <Unit name="mm/s"><BaseUnit m="1" s="-1" factor="0.001"/></Unit>
  </UnitDefinitions>
  <TypeDefinitions>
    <SimpleType name="Temperature"><Real unit="degC" relativeQuantity="true" min="-273.15" max="1000" nominal="-300"/></SimpleType>
    <SimpleType name="Mode"><Enumeration><Item name="off" value="1"/><Item name="on" value="7"/></Enumeration></SimpleType>
    <SimpleType name="Switch"><Boolean/></SimpleType>
  </TypeDefinitions>
  <LogCategories><Category name="logAll"/></LogCategories>
  <DefaultExperiment startTime="0" stopTime="12.5" tolerance="1e-4" stepSize="0.01"/>
  <VendorAnnotations><Tool name="a tool"/></VendorAnnotations>
  <ModelVariables>
    <ScalarVariable name="time" valueReference="0" causality="independent"><Real/></ScalarVariable>
    <ScalarVariable name="inflow[1]" valueReference="536870912" causality="input" description="in">
      <Real unit="mm/s" start="0.5" min="0"/></ScalarVariable>
    <ScalarVariable name="on" valueReference="536870912" causality="input" variability="discrete">
      <Boolean declaredType="Switch" start="true"/></ScalarVariable>
    <ScalarVariable name="mode" valueReference="4294967295" causality="parameter" variability="tunable">
      <Enumeration declaredType="Mode" start="7"/></ScalarVariable>
    <ScalarVariable name="count" valueReference="0" causality="output"><Integer/></ScalarVariable>
    <ScalarVariable name="T" valueReference="2" causality="output">
      <Real declaredType="Temperature" relativeQuantity="false" max="99"/></ScalarVariable>
    <ScalarVariable name="T2" valueReference="2" causality="local" initial="approx">
      <Real declaredType="Temperature" start="20"/></ScalarVariable>
    <ScalarVariable name="label" valueReference="0" causality="parameter"><String start=" a b "/></ScalarVariable>
    <ScalarVariable name="heat" valueReference="5" causality="calculatedParameter"
        variability="fixed"><Real/><Annotations/></ScalarVariable>
    <ScalarVariable name="pi" valueReference="6" variability="constant"><Real start="3.14"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="5" dependencies="2 3" dependenciesKind="dependent fixed"/><Unknown index="6"/></Outputs>
    <Derivatives><Unknown index="7"/></Derivatives>
    <InitialUnknowns><Unknown index="5" dependencies=""/><Unknown index="9" dependencies="4"/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
)";

importer::ModelDescription fmi2_tank() {
  return importer::parse_model_description(kTank, "unit.xml");
}

core::Variable variable(const std::string& name) {
  const auto unit = fmi2_tank();
  return unit.variables[unit.find(name).value()];
}

/// The description with a part replaced.
importer::ModelDescription fmi2_with(const std::string& part, const std::string& replacement) {
  std::string text = kTank;
  const std::size_t at = text.find(part);
  REQUIRE(at != std::string::npos);
  text.replace(at, part.size(), replacement);
  return importer::parse_model_description(text, "unit.xml");
}

/// The error of it.
std::string fmi2_error_with(const std::string& part, const std::string& replacement) {
  return input_error([&] { fmi2_with(part, replacement); });
}

}  // namespace

TEST_CASE("an FMI 2.0 unit's attributes and capabilities") {
  const auto unit = fmi2_tank();
  CHECK(unit.fmi_version == "2.0");
  CHECK(unit.model_name == "Tank 2");
  CHECK(unit.model_identifier == "tank");
  CHECK(unit.instantiation_token == "{8c4e810f}");
  CHECK(unit.description == "A tank");
  CHECK(unit.generation_tool == "a tool");
  CHECK((unit.can_save_state && unit.can_serialize_state && unit.can_vary_step));
  CHECK((unit.single_instance && unit.needs_execution_tool && unit.may_reject));
  CHECK(unit.provides_intermediate_update);
  CHECK_FALSE((unit.has_event_mode || unit.may_return_early || unit.promises_idle));
  CHECK(unit.max_output_derivative_order == 3);
  CHECK(unit.default_step == 10ms);
  CHECK(unit.default_stop == Time(12'500ms));
  CHECK(unit.units_of_measure.at("degC").offset == 273.15L);
  CHECK(unit.units_of_measure.at("mm/s").exponents == std::array<int, 8>{0, 1, -1, 0, 0, 0, 0, 0});
  REQUIRE(unit.fmi2);
  CHECK(unit.fmi2->can_run_asynchronously);
  const auto plain = importer::parse_model_description(
      R"(<fmiModelDescription fmiVersion="2.0" modelName="x" guid="x"><CoSimulation
      modelIdentifier="x"/><ModelVariables/><ModelStructure/></fmiModelDescription>)",
      "unit.xml");
  CHECK_FALSE((plain.can_save_state || plain.can_vary_step || plain.single_instance));
  CHECK_FALSE((plain.provides_intermediate_update || plain.fmi2->can_run_asynchronously));
}

TEST_CASE("a difference of FMI 2.0 is one by its own word, or that of its type") {
  const auto unit = fmi2_tank();
  const auto is_relative = [&](const char* name) {
    return unit.variables[unit.find(name).value()].is_relative;
  };
  CHECK(is_relative("T2"));
  CHECK_FALSE(is_relative("T"));
  CHECK_FALSE(is_relative("inflow[1]"));
}

TEST_CASE("core's references are places; the unit's are kept beside them") {
  const auto unit = fmi2_tank();
  REQUIRE(unit.variables.size() == 10);
  for (std::size_t i = 0; i < unit.variables.size(); ++i) CHECK(unit.variables[i].reference == i);
  CHECK(unit.fmi2->references ==
        std::vector<fmi2ValueReference>{0, 536870912, 536870912, 4294967295, 0, 2, 2, 0, 5, 6});
}

TEST_CASE("an FMI 2.0 unit's variables") {
  const core::Variable inflow = variable("inflow[1]");
  CHECK(inflow.type == ValueType::Float64);
  CHECK(inflow.causality == Causality::Input);
  CHECK(inflow.variability == Variability::Continuous);
  CHECK(inflow.initial == Initial::Exact);
  CHECK((inflow.dimensions.empty() && inflow.size == 1));
  CHECK(
      (inflow.unit == "mm/s" && inflow.start == "0.5" && inflow.min == "0" && inflow.max.empty()));
  CHECK(inflow.description == "in");
  CHECK(variable("time").causality == Causality::Independent);
  CHECK(variable("on").type == ValueType::Boolean);
  CHECK(variable("count").type == ValueType::Int32);
  CHECK(variable("label").type == ValueType::String);
  CHECK(variable("label").start == " a b ");
  CHECK(variable("label").variability == Variability::Fixed);
  CHECK(variable("heat").initial == Initial::Calculated);
  CHECK(variable("pi").initial == Initial::Exact);
  CHECK(variable("T2").initial == Initial::Approx);
}

TEST_CASE("an attribute that a variable does not have comes from its declared type") {
  const core::Variable t = variable("T");
  CHECK((t.unit == "degC" && t.min == "-273.15" && t.max == "99" && t.nominal == 300));
  const core::Variable mode = variable("mode");
  CHECK(mode.type == ValueType::Enumeration);
  CHECK(mode.items == std::vector<std::pair<std::string, std::int64_t>>{{"off", 1}, {"on", 7}});
  CHECK(core::parse(mode, mode.start).numbers<std::int64_t>()[0] == 7);
}

TEST_CASE("aliases are variables of their own, which differ in what may be done with them") {
  const auto unit = fmi2_tank();
  const auto output = unit.find("T").value();
  const auto local = unit.find("T2").value();
  CHECK(output != local);
  CHECK(unit.fmi2->references[output] == unit.fmi2->references[local]);
  CHECK(unit.variables[output].causality == Causality::Output);
  CHECK(unit.variables[local].causality == Causality::Local);
  CHECK(unit.variables[std::max(output, local)].shares_value_of ==
        unit.variables[std::min(output, local)].reference);
  CHECK(!unit.variables[std::min(output, local)].shares_value_of);
}

TEST_CASE("two inputs cannot be aliases") {
  CHECK_THAT(
      fmi2_error_with(R"(name="T2" valueReference="2" causality="local" initial="approx")",
                      R"(name="T2" valueReference="536870912" causality="input")"),
      Contains("unit.xml:") &&
          Contains("the input 'T2' has the value reference 536870912 of the input 'inflow[1]'"));
}

TEST_CASE("only floating-point numbers are continuous, whatever the default") {
  CHECK(variable("count").variability == Variability::Discrete);
  CHECK(variable("T").variability == Variability::Continuous);
  std::string text = kTank;
  const std::string name = "name=\"count\"";
  text.replace(text.find(name), name.size(), name + " variability=\"continuous\"");
  const auto unit = importer::parse_model_description(text, "unit.xml");
  CHECK(unit.variables[*unit.find("count")].variability == Variability::Discrete);
}

TEST_CASE("only continuous inputs of a unit that interpolates change within a step") {
  for (const core::Variable& v : fmi2_tank().variables) {
    CAPTURE(v.name);
    CHECK(v.intermediate_update == (v.name == "inflow[1]"));
  }
  std::string text = kTank;
  const std::string can = "canInterpolateInputs=\"true\"";
  text.erase(text.find(can), can.size());
  const auto unit = importer::parse_model_description(text, "unit.xml");
  CHECK_FALSE(unit.provides_intermediate_update);
  CHECK_FALSE(unit.variables[*unit.find("inflow[1]")].intermediate_update);
}

TEST_CASE("the indices of ModelStructure count from 1, in lists of knowns, too") {
  const auto unit = fmi2_tank();
  REQUIRE(unit.outputs.size() == 2);
  CHECK(unit.outputs[0].reference == 4);
  CHECK(unit.outputs[0].dependencies == std::vector<core::ValueReference>{1, 2});
  CHECK(unit.outputs[1].reference == 5);
  CHECK_FALSE(unit.outputs[1].dependencies);
  REQUIRE(unit.initial_unknowns.size() == 2);
  CHECK(unit.initial_unknowns[0].dependencies == std::vector<core::ValueReference>{});
  CHECK(unit.initial_unknowns[1].reference == 8);
  CHECK(unit.initial_unknowns[1].dependencies == std::vector<core::ValueReference>{3});
}

TEST_CASE("a ModelStructure with an index that no variable has is ignored, with a warning") {
  const auto [part, replacement, index] = GENERATE(table<std::string, std::string, std::string>({
      {"index=\"6\"", "index=\"0\"", "0"},
      {"dependencies=\"2 3\"", "dependencies=\"2 11\"", "11"},
  }));
  std::string text = kTank;
  const std::size_t at = text.find(part);
  REQUIRE(at != text.npos);
  const auto unit =
      importer::parse_model_description(text.replace(at, part.size(), replacement), "unit.xml");
  CHECK(unit.outputs.empty());
  REQUIRE(!unit.warnings.empty());
  CHECK_THAT(unit.warnings.back(),
             Contains("<Unknown> refers to the variable with the index " + index +
                      "; expected one from 1 to 10; <ModelStructure> is ignored"));
}

TEST_CASE("errors of broken FMI 2.0 descriptions have the line") {
  CHECK_THAT(fmi2_error_with("guid=\"{8c4e810f}\"", ""),
             Contains("unit.xml:2: ") && Contains("'guid'"));
  CHECK_THAT(fmi2_error_with("declaredType=\"Mode\"", "declaredType=\"Mood\""),
             Contains("declaredType=\"Mood\": there is no such type"));
  CHECK_THAT(fmi2_error_with("declaredType=\"Mode\"", "declaredType=\"Temperature\""),
             Contains("declaredType=\"Temperature\" is a <Real>; expected a <Enumeration>"));
  CHECK_THAT(fmi2_error_with("declaredType=\"Mode\"", ""), Contains("'declaredType'"));
  CHECK_THAT(fmi2_error_with("<Integer/>", "<Int32/>"),
             Contains("<ScalarVariable> has none of <Real>, <Integer>"));
  CHECK_THAT(fmi2_error_with("<Boolean/></SimpleType>", "</SimpleType>"),
             Contains("<SimpleType> has none of"));
  CHECK_THAT(fmi2_error_with("SimpleType name=\"Switch\"", "SimpleType name=\"Mode\""),
             Contains("the type 'Mode' is defined twice"));
  CHECK_THAT(fmi2_error_with("causality=\"local\"", "causality=\"structuralParameter\""),
             Contains("there are none in FMI 2.0"));
  CHECK_THAT(fmi2_error_with("valueReference=\"5\"", "valueReference=\"-5\""), Contains("\"-5\""));
  CHECK_THAT(fmi2_error_with("initial=\"approx\"", "initial=\"guessed\""),
             Contains("expected calculated or exact or approx"));
  CHECK_THAT(fmi2_error_with("ModelVariables>", "Variables>"), Contains("unit.xml"));
}

TEST_CASE("a unit for Model Exchange only is refused by name") {
  std::string text = kTank;
  const auto first = text.find("<CoSimulation");
  const std::string last = "</CoSimulation>";
  text.erase(first, text.find(last) + last.size() - first);
  CHECK_THAT(input_error([&] { importer::parse_model_description(text, "unit.xml"); }),
             Contains("no Co-Simulation interface") && Contains("it has ModelExchange only") &&
                 Contains("hint: export the unit for Co-Simulation"));
}

TEST_CASE("a start value of FMI 2.0 is of the variable's type") {
  const auto [from, to, message] = GENERATE(table<std::string, std::string, std::string>({
      {"start=\"0.5\"", "start=\"abc\"",
       "'inflow[1]': 'abc' is not a value for it, expected a Float64"},
      {"start=\"0.5\"", "start=\"1 2\"", "'inflow[1]' has 2 elements, the variable has 1"},
      {"start=\"true\"", "start=\"2.5\"",
       "'on': '2.5' is not a value for it, expected true or false"},
      {"start=\"7\"", "start=\"on\"", "'mode': 'on' is not a value for it"},
      {"<Integer/>", "<Integer start=\"99999999999\"/>", "'count': "},
  }));
  std::string text = kTank;
  text.replace(text.find(from), from.size(), to);
  CHECK_THAT(input_error([&] { importer::parse_model_description(text, "unit.xml"); }),
             Contains("unit.xml:") && Contains("the start value of " + message));
}

TEST_CASE("a capability that is True, as some tools write, is taken with a warning") {
  std::string text = kTank;
  const std::string own = "canHandleVariableCommunicationStepSize=\"true\"";
  REQUIRE(text.find(own) != std::string::npos);
  text.replace(text.find(own), own.size(), "canHandleVariableCommunicationStepSize=\"True\"");
  const auto unit = importer::parse_model_description(text, "unit.xml");
  CHECK(unit.can_vary_step);
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:") && Contains("is taken for true"));
}

TEST_CASE("start values as other tools write them are taken, with a warning") {
  std::string text = kTank;
  const std::string switched = "<Boolean declaredType=\"Switch\" start=\"true\"/>";
  REQUIRE(text.find(switched) != std::string::npos);
  text.replace(text.find(switched), switched.size(),
               "<Boolean declaredType=\"Switches\" start=\"True\"/>");
  const auto unit = importer::parse_model_description(text, "unit.xml");
  REQUIRE(unit.warnings.size() == 2);
  CHECK_THAT(unit.warnings[0], Contains("declaredType=\"Switches\" is ignored"));
  CHECK_THAT(unit.warnings[1],
             Contains("unit.xml:") && Contains("start=\"True\"") && Contains("is taken for true"));
}

TEST_CASE("start values that are no items, or not finite, are said") {
  const auto other_item = fmi2_with("start=\"7\"", "start=\"2\"");
  REQUIRE(other_item.warnings.size() == 1);
  CHECK_THAT(other_item.warnings[0],
             Contains("unit.xml:") && Contains("start=\"2\" of 'mode' is not an item of its "
                                               "Enumeration: off (1), on (7)"));
  const auto infinite = fmi2_with("start=\"0.5\"", "start=\"INF\"");
  REQUIRE(infinite.warnings.size() == 1);
  CHECK_THAT(infinite.warnings[0], Contains("start=\"INF\" of 'inflow[1]' is not a finite number"));
}

TEST_CASE("a variable of FMI 2.0 whose name is there already is left out, and indices stay right") {
  const auto unit = fmi2_with("name=\"T2\"", "name=\"T\"");
  REQUIRE_FALSE(unit.warnings.empty());
  CHECK_THAT(unit.warnings[0], Contains("the variable name 'T' is used twice"));
  CHECK(unit.ambiguous_names.contains("T"));  // another causality
  CHECK(unit.variables[*unit.find("T")].causality == Causality::Output);
  REQUIRE(unit.initial_unknowns.size() == 2);
  CHECK(unit.initial_unknowns[1].reference == unit.find("heat"));
  CHECK(unit.fmi2->references.size() == unit.variables.size());
}

TEST_CASE("two units of measure of one value reference are a warning") {
  CHECK(fmi2_with("<Real declaredType=\"Temperature\" start=\"20\"/>", "<Real start=\"20\"/>")
            .warnings.empty());
  const auto unit = fmi2_with("<Real declaredType=\"Temperature\" start=\"20\"/>",
                              "<Real unit=\"mm/s\" start=\"20\"/>");
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("'T2' has the value of 'T'") &&
                                   Contains("another unit of measure, 'mm/s', not 'degC'"));
}
