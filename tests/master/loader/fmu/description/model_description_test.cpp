#include "master/loader/fmu/description/model_description.h"

#include "master/base/limited_warnings.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::Causality;
using core::Initial;
using core::IntervalVariability;
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
    <Float64Type name="Temperature" unit="degC" min="-273.15" max="1000" nominal="300"/>
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

/// The complete description after one change to its text.
core::UnitDescription parse_with(const std::string& from, const std::string& to) {
  std::string text = kComplete;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return importer::parse_model_description(text, "unit.xml");
}

/// The complaint about it.
std::string error_with(const std::string& from, const std::string& to) {
  CAPTURE(from, to);
  return input_error([&] { parse_with(from, to); });
}

/// The description with an annotation of this type and content at its end.
core::UnitDescription annotated(const std::string& type, const std::string& content) {
  return parse_with("</fmiModelDescription>", "<Annotations><Annotation type=\"" + type + "\">" +
                                                  content +
                                                  "</Annotation></Annotations>"
                                                  "</fmiModelDescription>");
}

/// A clock with these attributes, of a declared type with those.
core::Variable clock_of(const std::string& attributes, const std::string& type_attributes = "") {
  const bool has_type = !type_attributes.empty();
  const std::string type = has_type ? "declaredType=\"Tick\" " : "";
  std::string text =
      description_text("x", "hasEventMode=\"true\"",
                       "<Clock name=\"tick\" valueReference=\"1\" causality=\"input\" " + type +
                           attributes + "/>\n");
  if (has_type) {
    text.insert(text.find("<ModelVariables>"), "<TypeDefinitions><ClockType name=\"Tick\" " +
                                                   type_attributes + "/></TypeDefinitions>\n");
  }
  return importer::parse_model_description(text, "unit.xml").variables[0];
}
std::string clock_error(const std::string& attributes) {
  CAPTURE(attributes);
  return input_error([&] { clock_of(attributes); });
}

/// What the description says of `initial` for a variable with these attributes.
Initial initial_of(const std::string& attributes, const std::string& type = "Float64") {
  const std::string variable =
      "<" + type + " name=\"x\" valueReference=\"1\" " + attributes + "/>\n";
  return importer::parse_model_description(description_text("x", "", variable), "unit.xml")
      .variables[0]
      .initial;
}

}  // namespace

TEST_CASE("a version of FMI without its minor number is the first one, with a warning") {
  std::string text = kComplete;
  const std::string version = "fmiVersion=\"3.0\"";
  text.replace(text.find(version), version.size(), "fmiVersion=\"3\"");
  const auto unit = importer::parse_model_description(text, "unit.xml");
  CHECK(unit.fmi_version == "3.0");
  REQUIRE(!unit.warnings.empty());
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:2: fmiVersion=\"3\" is taken for 3.0"));
}

TEST_CASE("the unit as a whole") {
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
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
  CHECK(unit.fixed_internal_step == Duration(1ms));
  CHECK(unit.default_step == Duration(10ms));
  CHECK(unit.default_stop == Time(12500ms));
}

TEST_CASE("capabilities are absent unless they are declared") {
  const auto unit = importer::parse_model_description(description_text("x", ""), "unit.xml");
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
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  REQUIRE(unit.units_of_measure.size() == 2);
  CHECK(unit.units_of_measure.at("degC").exponents == std::array<int, 8>{0, 0, 0, 0, 1, 0, 0, 0});
  CHECK(unit.units_of_measure.at("degC").offset == 273.15L);
  CHECK(unit.units_of_measure.at("mm/s").exponents == std::array<int, 8>{0, 1, -1, 0, 0, 0, 0, 0});
  CHECK(unit.units_of_measure.at("mm/s").factor == 0.001L);
}

TEST_CASE("a difference is one by its own word, or that of its type") {
  const auto unit = importer::parse_model_description(
      R"(<fmiModelDescription fmiVersion="3.0" modelName="m" instantiationToken="x">
  <CoSimulation modelIdentifier="m"/>
  <TypeDefinitions>
    <Float64Type name="Rise" unit="degC" relativeQuantity="true"/>
  </TypeDefinitions>
  <ModelVariables>
    <Float64 name="own" valueReference="1" unit="degC" relativeQuantity="1"/>
    <Float32 name="plain" valueReference="2" unit="degC"/>
    <Float64 name="typed" valueReference="3" declaredType="Rise"/>
    <Float64 name="absolute" valueReference="4" declaredType="Rise" relativeQuantity="false"/>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>)",
      "unit.xml");
  CHECK(variable(unit, "own").is_relative);
  CHECK_FALSE(variable(unit, "plain").is_relative);
  CHECK(variable(unit, "typed").is_relative);
  CHECK_FALSE(variable(unit, "absolute").is_relative);
}

TEST_CASE("variables keep their order, and their defaults are those of the standard") {
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
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
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "field").dimensions ==
        std::vector<core::Dimension>{{2, core::ValueReference{1}}, 3});
  CHECK(variable(unit, "field").size == 6);
  CHECK(variable(unit, "rows").size == 1);
}

TEST_CASE("a declared type gives what the variable leaves open") {
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "temperature").unit == "degC");
  CHECK(variable(unit, "temperature").min == "-273.15");
  CHECK(variable(unit, "temperature").max == "100");
  CHECK(variable(unit, "temperature").nominal == 300);
  CHECK(variable(unit, "level").nominal == 0);
  CHECK(variable(unit, "tick").clock.value().variability == IntervalVariability::Triggered);
  using Items = std::vector<std::pair<std::string, std::int64_t>>;
  CHECK(variable(unit, "mode").items == Items{{"off", 0}, {"on", 7}});
}

TEST_CASE("an alias is another name of its variable") {
  const auto unit = parse_with("<Alias name=\"height\"/>",
                               "<Alias name=\"height\"/><Alias name=\"rise\" description=\"x\"/>");
  CHECK(variable(unit, "level").aliases == std::vector<std::string>{"height", "rise"});
  CHECK(variable(unit, "height").name == "level");
  CHECK(variable(unit, "rise").name == "level");
  CHECK(variable(unit, "on").aliases.empty());
}

TEST_CASE("the default of `initial` depends on causality and variability") {
  const std::string fixed = "variability=\"fixed\" ";
  const std::string tunable = "variability=\"tunable\" ";
  const std::string discrete = "variability=\"discrete\" ";
  const std::string constant = "variability=\"constant\" start=\"1\" ";
  CHECK(initial_of("causality=\"parameter\"") == Initial::Exact);
  CHECK(initial_of(tunable + "causality=\"parameter\"") == Initial::Exact);
  CHECK(initial_of("causality=\"structuralParameter\"", "UInt64") == Initial::Exact);
  CHECK(initial_of("causality=\"input\"") == Initial::Exact);
  CHECK(initial_of(discrete + "causality=\"input\"") == Initial::Exact);
  CHECK(initial_of(constant + "causality=\"output\"") == Initial::Exact);
  CHECK(initial_of(constant + "causality=\"local\"") == Initial::Exact);
  CHECK(initial_of("causality=\"calculatedParameter\"") == Initial::Calculated);
  CHECK(initial_of(fixed + "causality=\"local\"") == Initial::Calculated);
  CHECK(initial_of(tunable + "causality=\"local\"") == Initial::Calculated);
  CHECK(initial_of("causality=\"output\"") == Initial::Calculated);
  CHECK(initial_of(discrete + "causality=\"output\"") == Initial::Calculated);
  CHECK(initial_of("") == Initial::Calculated);
  CHECK(initial_of("causality=\"input\" intervalVariability=\"triggered\"", "Clock") ==
        Initial::None);
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "time").initial == Initial::None);
}

TEST_CASE("a given `initial` must be allowed") {
  CHECK(initial_of("causality=\"output\" initial=\"exact\" start=\"1\"") == Initial::Exact);
  CHECK(initial_of("causality=\"output\" initial=\"approx\" start=\"1\"") == Initial::Approx);
  CHECK(initial_of("causality=\"calculatedParameter\" initial=\"approx\" start=\"1\"") ==
        Initial::Approx);
  CHECK_THAT(error_with("initial=\"calculated\"", "initial=\"guessed\""),
             Contains("unit.xml:23: initial=\"guessed\" of the continuous output 'field': expected "
                      "calculated or exact or approx"));
  CHECK_THAT(input_error([] { initial_of("causality=\"parameter\" initial=\"calculated\""); }),
             Contains("of the fixed parameter 'x': expected exact"));
  CHECK_THAT(input_error([] { initial_of("causality=\"calculatedParameter\" initial=\"exact\""); }),
             Contains("expected calculated or approx"));
  CHECK_THAT(error_with("causality=\"independent\"", "causality=\"independent\" initial=\"exact\""),
             Contains("of the continuous independent 'time': expected none"));
}

TEST_CASE("the internal step is a time that can be counted") {
  for (const std::string step : {"0", "-0.01", "1e-13", "inf", "nan", "1e16"}) {
    CHECK_THAT(
        error_with("fixedInternalStepSize=\"1e-3\"", "fixedInternalStepSize=\"" + step + "\""),
        Contains("unit.xml:5: fixedInternalStepSize=\"" + step + "\" of <CoSimulation>: "));
  }
}

TEST_CASE("what cannot be used of the default experiment is ignored, with a warning") {
  const auto check = [](const std::string& attribute, const std::string& from,
                        const std::string& to) {
    const auto unit = parse_with(attribute + "=\"" + from + "\"", attribute + "=\"" + to + "\"");
    CAPTURE(attribute, to);
    REQUIRE(unit.warnings.size() == 1);
    CHECK_THAT(unit.warnings[0], Contains("unit.xml:19: " + attribute + "=\"" + to +
                                          "\" of <DefaultExperiment> is ignored: expected"));
    return unit;
  };
  for (const char* step : {"0", "-0.01", "1e-13", "inf", "nan", "1e16", "0,01", ""}) {
    CHECK_FALSE(check("stepSize", "0.01", step).default_step);
  }
  for (const char* stop : {"0", "-1", "1e-13", "inf", "nan", "1,0", ""}) {
    CHECK_FALSE(check("stopTime", "12.5", stop).default_stop);
  }
  for (const char* start : {"inf", "nan", "1e16", ""}) {
    CHECK(check("startTime", "0", start).default_stop);
  }
  const auto ended = parse_with("startTime=\"0\"", "startTime=\"12.5\"");
  REQUIRE(ended.warnings.size() == 1);
  CHECK_THAT(ended.warnings[0], Contains("stopTime=\"12.5\"") && Contains("the start, 12.5 s"));
  CHECK(parse_with("stepSize=\"0.01\"", "stepSize=\"1e-12\"").default_step == Duration(1));
}

TEST_CASE("a default experiment that ends later than times can be counted has the last one") {
  CHECK(parse_with("stopTime=\"12.5\"", "stopTime=\"9.2e6\"").default_stop == Time(9'200'000s));
  CHECK(parse_with("stopTime=\"12.5\"", "stopTime=\"1e16\"").default_stop == Time::max());
}

TEST_CASE("a default experiment may begin at any time") {
  CHECK(importer::parse_model_description(kComplete, "unit.xml").default_start == Time());
  CHECK(parse_with("startTime=\"0\"", "startTime=\"3.5\"").default_start == Time(3500ms));
  CHECK(parse_with("startTime=\"0\"", "startTime=\"-2\"").default_start == Time(-2s));
  CHECK_FALSE(parse_with("startTime=\"0\"", "").default_start);
}

TEST_CASE("whether the unit may reject a step") {
  const std::string unit = "<stride:Unit xmlns:stride=\"urn:org.stride:unit:1\" mayReject=";
  CHECK(importer::parse_model_description(kComplete, "unit.xml").may_reject);
  CHECK_FALSE(annotated("org.stride.unit", unit + "\"false\"/>").may_reject);
  CHECK_FALSE(
      annotated("org.stride.unit", "<Unit xmlns=\"urn:org.stride:unit:1\" mayReject=\"0\"/>")
          .may_reject);
  CHECK(annotated("org.stride.unit", unit + "\"true\" maximumStep=\"0.25\"/>").maximum_step ==
        Duration(std::chrono::milliseconds(250)));
  CHECK(annotated("org.stride.unit", unit + "\"true\"/>").may_reject);
  CHECK(annotated("org.stride.unit", "<stride:Unit xmlns:stride=\"urn:org.stride:unit:1\"/>")
            .may_reject);
  CHECK(annotated("org.stride.unit", "<s:Unit xmlns:s=\"urn:another\" mayReject=\"false\"/>")
            .may_reject);
  CHECK(annotated("org.another", unit + "\"false\"/>").may_reject);
  CHECK_THAT(input_error([&] { annotated("org.stride.unit", unit + "\"perhaps\"/>"); }),
             Contains("unit.xml:") && Contains("mayReject=\"perhaps\""));
}

TEST_CASE("whether the unit's steps may be split") {
  const std::string unit = "<stride:Unit xmlns:stride=\"urn:org.stride:unit:1\" mayReject=\"0\"";
  CHECK_FALSE(annotated("org.stride.unit", unit + "/>").split_invariant);
  CHECK(annotated("org.stride.unit", unit + " splitInvariant=\"true\"/>").split_invariant);
  CHECK_FALSE(annotated("org.another", unit + " splitInvariant=\"true\"/>").split_invariant);
}

TEST_CASE("whether the unit allows snapshots") {
  const std::string unit = "<stride:Unit xmlns:stride=\"urn:org.stride:unit:1\" mayReject=\"0\"";
  CHECK(annotated("org.stride.unit", unit + "/>").allows_snapshots);
  CHECK_FALSE(annotated("org.stride.unit", unit + " allowsSnapshots=\"false\"/>").allows_snapshots);
}

TEST_CASE("which outputs are the unit's verdict and its text") {
  const auto judge = [](const std::string& attributes) {
    const std::string outputs =
        "<Boolean name=\"good\" valueReference=\"20\" causality=\"output\"/>"
        "<String name=\"why\" valueReference=\"21\" causality=\"output\"/>"
        "<Boolean name=\"seen\" valueReference=\"22\" causality=\"output\" clocks=\"5\"/>";
    std::string text = kComplete;
    text.insert(text.find("  </ModelVariables>"), outputs);
    text.insert(text.find("</fmiModelDescription>"),
                "<Annotations><Annotation type=\"org.stride.unit\">"
                "<s:Unit xmlns:s=\"urn:org.stride:unit:1\" " +
                    attributes + "/></Annotation></Annotations>");
    return importer::parse_model_description(text, "unit.xml");
  };
  const core::UnitDescription both = judge("verdictText=\"why\" verdict=\"good\"");
  CHECK(both.verdict == both.find("good"));
  CHECK(both.verdict_text == both.find("why"));
  CHECK_FALSE(judge("mayReject=\"false\"").verdict);
  CHECK_FALSE(judge("verdict=\"good\"").verdict_text);
  CHECK_THAT(input_error([&] { judge("verdict=\"god\""); }),
             Contains("unit.xml:") && Contains("verdict=\"god\" of <s:Unit> is not a variable; "
                                               "expected a scalar Boolean output without a clock"));
  for (const std::string other : {"why", "on", "seen"}) {
    CHECK_THAT(input_error([&] { judge("verdict=\"" + other + "\""); }),
               Contains("is another variable"));
  }
  CHECK_THAT(input_error([&] { judge("verdict=\"good\" verdictText=\"good\""); }),
             Contains("expected a scalar String output"));
}

TEST_CASE("start values and clocks") {
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  CHECK(variable(unit, "temperature").start == "20");
  CHECK(variable(unit, "words").start == "one two");
  CHECK(variable(unit, "frame").start == "00ff");
  CHECK(variable(unit, "frame").clocks == std::vector<core::ValueReference>{5});
}

TEST_CASE("a clock's interval is the fraction, else the decimal, else the unit's") {
  using core::Interval;
  const auto exact = clock_of(R"(intervalVariability="constant" intervalDecimal="0.3333333"
      supportsFraction="true" resolution="3000" intervalCounter="1000" shiftCounter="500"
      canBeDeactivated="true" priority="3")");
  REQUIRE(exact.clock);
  CHECK(exact.clock->variability == IntervalVariability::Constant);
  CHECK(exact.clock->interval == Interval::from_fraction(1, 3));
  CHECK(exact.clock->shift == Interval::from_fraction(1, 6));
  CHECK(exact.clock->supports_fraction);
  CHECK(exact.clock->can_be_deactivated);
  CHECK(exact.clock->priority == 3);
  CHECK(exact.is_time_based_clock());

  const auto decimal =
      clock_of(R"(intervalVariability="tunable" intervalDecimal="1e-3" shiftDecimal="0.1")");
  CHECK(decimal.clock->interval == Interval::from_fraction(1, 1000));
  CHECK(decimal.clock->shift == Interval::from_fraction(1, 10));
  CHECK_FALSE(decimal.clock->supports_fraction);

  const auto fixed = clock_of(R"(intervalVariability="fixed" supportsFraction="true")");
  CHECK_FALSE(fixed.clock->interval);
  CHECK_FALSE(clock_of(R"(intervalVariability="countdown")").clock->interval);
  CHECK_FALSE(clock_of(R"(intervalVariability="changing")").clock->priority);
  CHECK_FALSE(clock_of(R"(intervalVariability="triggered")").is_time_based_clock());
}

TEST_CASE("Booleans of variables and clocks may be written as other tools do, with a warning") {
  std::string text = kComplete;
  const std::string place = "name=\"field\" valueReference=\"2\"";
  text.insert(text.find(place) + place.size(), " intermediateUpdate=\" TRUE \"");
  const auto unit = importer::parse_model_description(text, "unit.xml");
  CHECK(variable(unit, "field").intermediate_update);
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:") && Contains("is taken for true"));
  const auto clock = clock_of(R"(intervalVariability="triggered" canBeDeactivated=" True ")",
                              R"(supportsFraction="TRUE")");
  CHECK(clock.clock->can_be_deactivated);
  CHECK(clock.clock->supports_fraction);
}

TEST_CASE("a clock's declared type gives what the clock leaves open") {
  const auto clock = clock_of(R"(intervalDecimal="0.5")",
                              R"(intervalVariability="constant" intervalDecimal="1"
                                 shiftDecimal="0.25" supportsFraction="true")");
  CHECK(clock.clock->variability == IntervalVariability::Constant);
  CHECK(clock.clock->interval == core::Interval::from_fraction(1, 2));
  CHECK(clock.clock->shift == core::Interval::from_fraction(1, 4));
  CHECK(clock.clock->supports_fraction);
}

TEST_CASE("a clock that cannot tick is an error with its line") {
  CHECK_THAT(clock_error(""), Contains("unit.xml:5") && Contains("'intervalVariability'"));
  CHECK_THAT(clock_error(R"(intervalVariability="often")"),
             Contains("intervalVariability=\"often\" of the clock 'tick'") &&
                 Contains("expected one of constant, fixed"));
  CHECK_THAT(clock_error(R"(intervalVariability="constant")"), Contains("'intervalDecimal'"));
  const std::string constant = R"(intervalVariability="constant" )";
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="-1")"), Contains("it is negative"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="0")"), Contains("at least the picosecond"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="1e-13")"),
             Contains("intervalDecimal=\"1e-13\"") && Contains("at least the picosecond"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="nan")"), Contains("not a number"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="soon")"), Contains("soon"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="1" shiftDecimal="-1")"),
             Contains("shiftDecimal=\"-1\"") && Contains("it is negative"));
  CHECK_THAT(clock_error(constant + R"(intervalCounter="0" resolution="1")"),
             Contains("intervalCounter=\"0\"") && Contains("at least the picosecond"));
  CHECK_THAT(clock_error(constant + R"(intervalCounter="1")"), Contains("resolution"));
  CHECK_THAT(clock_error(constant + R"(intervalCounter="1" resolution="0")"),
             Contains("resolution=\"0\"") && Contains("resolution is 0"));
  CHECK_THAT(clock_error(constant + R"(intervalDecimal="1" priority="-1")"), Contains("-1"));
  const std::string output =
      "<Clock name=\"out\" valueReference=\"1\" causality=\"output\" "
      "intervalVariability=\"countdown\"/>\n";
  CHECK_THAT(input_error([&] {
               importer::parse_model_description(description_text("x", "", output), "unit.xml");
             }),
             Contains("only an input can be a time-based clock"));
}

TEST_CASE("what belongs to a clock is discrete") {
  const std::string variables =
      "<Clock name=\"tick\" valueReference=\"1\" causality=\"input\" "
      "intervalVariability=\"countdown\"/>\n"
      "<Float64 name=\"u\" valueReference=\"2\" causality=\"input\" start=\"0\" clocks=\"1\"/>\n";
  const auto unit =
      importer::parse_model_description(description_text("x", "", variables), "unit.xml");
  CHECK(variable(unit, "u").variability == Variability::Discrete);
  CHECK(unit.is_sampled(variable(unit, "u")));
  CHECK_FALSE(unit.is_sampled(variable(unit, "tick")));
  CHECK_FALSE(unit.is_message(variable(unit, "u")));
}

TEST_CASE("what may change within a step") {
  const std::string variables =
      "<Float64 name=\"u\" valueReference=\"2\" causality=\"input\" start=\"0\" "
      "intermediateUpdate=\"true\"/>\n";
  const auto unit = importer::parse_model_description(
      description_text("x", "providesIntermediateUpdate=\"true\"", variables), "unit.xml");
  CHECK(unit.provides_intermediate_update);
  CHECK(variable(unit, "u").intermediate_update);
  CHECK_FALSE(variable(unit, "time").intermediate_update);
}

TEST_CASE("undeclared dependencies and an empty list are not the same") {
  const auto unit = importer::parse_model_description(kComplete, "unit.xml");
  REQUIRE(unit.outputs.size() == 2);
  CHECK(unit.outputs[0].dependencies == std::vector<core::ValueReference>{3, 4});
  CHECK_FALSE(unit.outputs[1].dependencies);
  REQUIRE(unit.initial_unknowns.size() == 1);
  CHECK(unit.initial_unknowns[0].dependencies == std::vector<core::ValueReference>{});
}

TEST_CASE("other versions of FMI are named") {
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", "fmiVersion=\"2.0\""),
             Contains("unit.xml:2: ") && Contains("the attribute 'guid'"));
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", "fmiVersion=\"4.0\""),
             Contains("fmiVersion=\"4.0\" is not supported; expected 1.0, 2.0 or 3.0") &&
                 Contains("hint: export the unit as FMI 3.0 or FMI 2.0 Co-Simulation"));
  CHECK_THAT(error_with("fmiVersion=\"3.0\"", ""), Contains("needs the attribute 'fmiVersion'"));
  CHECK_THAT(input_error([] { importer::parse_model_description("<html/>", "unit.xml"); }),
             Contains("the document is a <html>"));
  std::string text = kComplete;
  text.replace(text.find("3.0"), 3, "3.1");
  CHECK(importer::parse_model_description(text, "unit.xml").fmi_version == "3.1");
}

TEST_CASE("the error of a unit without Co-Simulation lists its interface types") {
  const std::string text = R"(<fmiModelDescription fmiVersion="3.0" modelName="x"
    instantiationToken="x"><ModelExchange modelIdentifier="x"/><ScheduledExecution
    modelIdentifier="x"/></fmiModelDescription>)";
  CHECK_THAT(input_error([&] { importer::parse_model_description(text, "unit.xml"); }),
             Contains("no Co-Simulation interface") &&
                 Contains("it has ModelExchange, ScheduledExecution only"));
}

TEST_CASE("broken documents") {
  CHECK_THAT(
      error_with("</ModelVariables>", "</ModelVariable>"),
      Contains("unit.xml:") && Contains("not well-formed XML: </ModelVariable> ends no element"));
  CHECK_THAT(input_error([] { importer::parse_model_description("", "unit.xml"); }),
             Contains("the file holds nothing"));
  CHECK_THAT(error_with("<ModelVariables>", "<Other>"), Contains("not well-formed"));
  CHECK_THAT(input_error([] { importer::read_model_description("/absent.xml", "shown.xml"); }),
             Contains("shown.xml: the file does not exist"));
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
  CHECK_THAT(error_with("<Boolean name", "<Bool name"),
             Contains("<Bool> is not a type of FMI 3.0"));
  CHECK_THAT(error_with("causality=\"input\"", "causality=\"inward\""),
             Contains("expected one of parameter, "));
  CHECK_THAT(error_with("variability=\"tunable\"", "variability=\"often\""),
             Contains("expected one of constant, "));
  CHECK_THAT(error_with("factor=\"0.001\"", "factor=\"0\""), Contains("cannot be zero"));
  CHECK_THAT(error_with("factor=\"0.001\"", "factor=\"NaN\""),
             Contains("factor=\"NaN\" of <BaseUnit>: expected a finite number"));
  CHECK_THAT(error_with("offset=\"273.15\"", "offset=\"inf\""), Contains("a finite number"));
  CHECK_THAT(error_with("start=\" 2\"", "start=\" \""), Contains("unit.xml:") && Contains("start"));
  CHECK_THAT(error_with("max=\"100\"", "max=\"NaN\""),
             Contains("max=\"NaN\" of 'temperature': expected a number"));
}

TEST_CASE("of several variables with one name the first one counts, with a warning") {
  const auto twice = parse_with("name=\"level\"", "name=\"on\"");
  CHECK(variable(twice, "on").type == ValueType::Boolean);
  CHECK_FALSE(twice.find("height"));
  CHECK(twice.ambiguous_names == std::set<std::string>{"on"});
  REQUIRE_FALSE(twice.warnings.empty());
  CHECK_THAT(twice.warnings[0], Contains("unit.xml:34: ") &&
                                    Contains("'on' is used twice, first in line 33: the first one "
                                             "counts"));
  const auto alias = parse_with("name=\"height\"", "name=\"on\"");
  CHECK(variable(alias, "on").type == ValueType::Boolean);
  CHECK(variable(alias, "level").aliases.empty());
  CHECK(alias.ambiguous_names == std::set<std::string>{"on"});
  const auto own = parse_with("name=\"height\"", "name=\"level\"");
  CHECK(own.ambiguous_names.empty());
  REQUIRE(own.warnings.size() == 1);
  CHECK_THAT(own.warnings[0], Contains("they are the same"));
}

TEST_CASE("names and value references are unique") {
  CHECK_THAT(error_with("<Alias name=\"height\"/>", "<Alias/>"), Contains("'name'"));
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
  CHECK_THAT(error_with("declaredType=\"Mode\"", "declaredType=\"Mood\""),
             Contains("no such type"));
  CHECK_THAT(error_with("declaredType=\"Temperature\"", "declaredType=\"Mode\""),
             Contains("is a <EnumerationType>; expected a <Float64Type>"));
  CHECK_THAT(error_with("declaredType=\"Mode\"", ""), Contains("'declaredType'"));
  CHECK_THAT(error_with("declaredType=\"Tick\"", ""), Contains("'intervalVariability'"));
}

TEST_CASE("a model structure that cannot be used is ignored, with a warning") {
  const auto [from, to, message] = GENERATE(table<std::string, std::string, std::string>({
      {"<Output valueReference=\"9\"/>", "<Output valueReference=\"99\"/>",
       "<Output> refers to the value reference 99"},
      {"dependencies=\"3 4\"", "dependencies=\"3 44\"", "the value reference 44"},
  }));
  const auto unit = parse_with(from, to);
  CHECK(unit.outputs.empty());
  CHECK(unit.initial_unknowns.empty());
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:") && Contains(message) &&
                                   Contains("<ModelStructure> is ignored") &&
                                   Contains("each output may depend on all inputs"));
}

TEST_CASE("a model structure that is missing is a warning") {
  std::string text = kComplete;
  const std::string end = "</ModelStructure>";
  const std::size_t begin = text.find("<ModelStructure>");
  text.erase(begin, text.find(end) + end.size() - begin);
  const auto unit = importer::parse_model_description(text, "unit.xml");
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:2: <ModelStructure> is missing"));
}

TEST_CASE("a slip that is in each variable does not fill the screen") {
  std::string variables;
  for (int i = 0; i < 500; ++i) {
    variables += "<Boolean name=\"b" + std::to_string(i) + "\" valueReference=\"" +
                 std::to_string(1000 + i) +
                 "\" causality=\"parameter\" variability=\"fixed\" "
                 "start=\"True\"/>\n";
  }
  const auto unit =
      importer::parse_model_description(description_text("x", "", variables), "unit.xml");
  CHECK(variable(unit, "b499").start == "true");
  REQUIRE(unit.warnings.size() == core::LimitedWarnings::kMostShown + 1);
  CHECK(unit.warnings.back() == "… and 480 more warnings for unit.xml");
}

TEST_CASE("a description with more elements than memory holds is refused") {
  CHECK_THAT(error_with("<Dimension start=\"3\"/>", "<Dimension start=\"4294967296\"/>"),
             Contains("variable 'field' has more than"));
  CHECK_THAT(error_with("<Dimension start=\"3\"/>",
                        "<Dimension start=\"100000\"/><Dimension start=\"100000\"/>"),
             Contains("variable 'field' has more than"));
}

TEST_CASE("a start value is of the variable's type, and as long as the variable or one element") {
  CHECK_THAT(error_with("start=\"20\"", "start=\"abc\""),
             Contains("unit.xml:25: the start value of 'temperature': 'abc' is not a value for it, "
                      "expected a Float64 number"));
  CHECK_THAT(error_with("start=\"20\"", "start=\"20 21\""),
             Contains("unit.xml:25: the start value of 'temperature' has 2 elements, the variable "
                      "has 1"));
  CHECK_THAT(error_with("start=\"7\"", "start=\"on\""), Contains("the start value of 'mode'"));
  CHECK_THAT(error_with("<Start value=\"00ff\"/>", "<Start value=\"0f0\"/>"),
             Contains("the start value of 'frame'") && Contains("an even number"));
  CHECK_THAT(error_with("<Start value=\"two\"/>", "<Start value=\"two\"/><Start value=\"three\"/>"),
             Contains("the start value of 'words' has 3 elements, the variable has 2"));
  CHECK_THAT(error_with("valueReference=\"8\"/>", "valueReference=\"8\" start=\"yes\"/>"),
             Contains("the start value of 'on'") && Contains("true or false"));
  const auto field = [](const std::string& start) {
    std::string text = kComplete;
    const std::string place = "name=\"field\" valueReference=\"2\"";
    return text.insert(text.find(place) + place.size(), " start=\"" + start + "\"");
  };
  const auto read = [&](const std::string& start) {
    importer::parse_model_description(field(start), "unit.xml");
  };
  CHECK_NOTHROW(read("1 2 3\n4 5 6"));
  CHECK_NOTHROW(read("1"));  // for each element
  CHECK_NOTHROW(read("INF"));
  CHECK_THAT(input_error([&] { read("1 2 3 4 5"); }),
             Contains("the start value of 'field' has 5 elements, the variable has 6"));
}

TEST_CASE("a least or greatest value is a number") {
  CHECK_THAT(error_with("max=\"100\"", "max=\"much\""),
             Contains("unit.xml:25: max=\"much\" of 'temperature': expected a number"));
  CHECK_THAT(error_with("min=\"-273.15\"", "min=\"1 2\""),
             Contains("min=\"1 2\" of 'temperature'"));
}

TEST_CASE("attributes whose meaning is clear, or that cannot hold, are a warning") {
  struct Slip {
    const char *from, *to, *warning;
  };
  for (const auto& [from, to, warning] :
       {Slip{"start=\"20\"", "start=\"\"", "start=\"\" of 'temperature' has no value, and is"},
        {"max=\"100\"", "max=\"-300\"", "'temperature' is above max=\"-300\"; both are ignored"},
        {"variability=\"tunable\"", "variability=\"Tunable\"", "is taken for tunable"},
        {"causality=\"independent\"", "causality=\"Independent\"", "is taken for independent"},
        {"<CoSimulation ", "<Cosimulation ", "<Cosimulation> is taken for <CoSimulation>"}}) {
    CAPTURE(to);
    const auto unit = parse_with(from, to);
    REQUIRE(unit.warnings.size() == 1);
    CHECK_THAT(unit.warnings[0], Contains("unit.xml:") && Contains(warning));
    CHECK(variable(unit, "mode").variability == Variability::Tunable);
    CHECK(variable(unit, "time").causality == Causality::Independent);
  }
  CHECK(variable(parse_with("start=\"20\"", "start=\"\""), "temperature").start == "");
  const auto without = parse_with("max=\"100\"", "max=\"-300\"");
  CHECK(variable(without, "temperature").min + variable(without, "temperature").max == "");
}

TEST_CASE("a declared type that is not there is ignored, with a warning") {
  const auto unit = parse_with("declaredType=\"Temperature\"", "declaredType=\"Heat\"");
  REQUIRE(unit.warnings.size() == 1);
  CHECK_THAT(unit.warnings[0], Contains("unit.xml:") && Contains("declaredType=\"Heat\"") &&
                                   Contains("no such type"));
}

TEST_CASE("a namespace that FMI does not have is an error that names it") {
  CHECK_THAT(error_with("<fmiModelDescription ", "<fmiModelDescription xmlns=\"urn:other\" "),
             Contains("is in the namespace 'urn:other'") && Contains("leave out the xmlns"));
}
