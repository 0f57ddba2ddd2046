#include "master/engine/model/system/system.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const BaseUnitOfMeasure kMetres{{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0};
const BaseUnitOfMeasure kMillimetres{{0, 1, 0, 0, 0, 0, 0, 0}, 1e-3, 0};
const BaseUnitOfMeasure kSeconds{{0, 0, 1, 0, 0, 0, 0, 0}, 1, 0};

std::shared_ptr<const UnitDescription> description() {
  return Describe("model")
      .unit("m", kMetres)
      .unit("mm", kMillimetres)
      .unit("s", kSeconds)
      .input("u", "m")
      .output("y", "mm")
      .output("t", "s")
      .add("n", ValueType::Int32, Causality::Input)
      .add("gain", ValueType::Float64, Causality::Parameter)
      .add("clock_in", ValueType::Clock, Causality::Input)
      .add("frame_in", ValueType::Binary, Causality::Input)
      .clocked_by(5)
      .add("clock_out", ValueType::Clock, Causality::Output)
      .add("frame_out", ValueType::Binary, Causality::Output)
      .clocked_by(7)
      .output("pair")
      .size(2)
      .add("ranged", ValueType::Float64, Causality::Parameter)
      .range("0", "2")
      .add("short", ValueType::Float32, Causality::Input, "m")
      .input("trio")
      .size(3)
      .done();
}

SystemDeclaration declaration() {
  SystemDeclaration system;
  system.name = "test";
  system.components = {{"alpha", description(), {}, {"s.ssd", 3}},
                       {"beta", description(), {}, {"s.ssd", 4}}};
  return system;
}

ConnectionDeclaration wire(const std::string& from, const std::string& to, int line = 9) {
  return {"alpha", from, "beta", to, false, {"s.ssd", line}};
}

std::string reason(const SystemDeclaration& system) {
  try {
    System{system};
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    return error.what();
  }
  return "accepted";
}

std::string reason(std::vector<ConnectionDeclaration> connections) {
  SystemDeclaration system = declaration();
  system.connections = std::move(connections);
  return reason(system);
}

}  // namespace

TEST_CASE("a valid system is built, with conversions") {
  SystemDeclaration declared = declaration();
  declared.connections = {wire("y", "u")};
  declared.start_values = {{"beta", "gain", "2.5", {}, {"s.ssd", 12}},
                           {"beta", "gain", "3.5", {}, {"--set", 0}}};
  const System system(declared);
  REQUIRE(system.connections().size() == 1);
  CHECK(system.connections()[0].conversion.linear.factor == Approx(1e-3));
  CHECK(system.full_name(system.connections()[0].from) == "alpha.y");
  REQUIRE(system.start_values().size() == 1);
  CHECK(element_text(system.start_values()[0].value, 0) == "3.5");
}

TEST_CASE("a connector of SSP 1.0 for a variable of another kind is a warning") {
  const auto warnings = [](const std::string& name, ValueType kin) {
    SystemDeclaration declared = declaration();
    ConnectorDeclaration connector;
    connector.name = name;
    connector.where = {"s.ssd", 5};
    connector.kin = kin;
    declared.components[0].connectors = {connector};
    return System(declared).warnings();
  };
  CHECK(warnings("y", ValueType::Float64).empty());
  CHECK(warnings("short", ValueType::Float64).empty());
  CHECK(warnings("n", ValueType::Int32).empty());
  for (const auto& [name, kin] : {std::pair("y", ValueType::Int32), {"n", ValueType::Float64}}) {
    REQUIRE(warnings(name, kin).size() == 1);
    CHECK_THAT(warnings(name, kin)[0], Contains("s.ssd:5: unit 'alpha'") &&
                                           Contains("the connector has") &&
                                           Contains("the unit has"));
  }
}

TEST_CASE("names that do not exist are named with the nearest that does") {
  CHECK_THAT(
      reason({{"alpa", "y", "beta", "u", false, {"s.ssd", 9}}}),
      Contains("s.ssd:9") && Contains("no component 'alpa'") && Contains("did you mean 'alpha'?"));
  CHECK_THAT(reason({wire("y", "gian")}),
             Contains("unit 'beta', variable 'gian'") && Contains("did you mean 'gain'?"));
  SystemDeclaration system = declaration();
  system.start_values = {{"beta", "gan", "1", {}, {"s.ssd", 12}}};
  CHECK_THAT(reason(system), Contains("s.ssd:12") && Contains("did you mean 'gain'?"));
}

TEST_CASE("a connection goes from an output to an input of the same type and size") {
  CHECK_THAT(reason({wire("u", "u")}),
             Contains("'alpha.u' is not an output but input, and 'beta.u' is input") &&
                 Contains("connect the output that both are to follow to each of them"));
  CHECK_THAT(reason({wire("y", "y")}),
             Contains("'beta.y' is not an input but output, and 'alpha.y' is output") &&
                 Contains("end the connection at an input"));
  CHECK_THAT(reason({wire("y", "gain")}), Contains("'beta.gain' is not an input but parameter"));
  CHECK_THAT(reason({wire("y", "n")}), Contains("Float64 and Int32 are different types"));
  CHECK_THAT(reason({wire("pair", "trio")}), Contains("an array of 2 elements and an array of 3"));
  CHECK_THAT(reason({wire("y", "trio")}), Contains("a scalar and an array of 3"));
}

TEST_CASE("a connection from an input to an output is one the other way round, with a warning") {
  SystemDeclaration declared = declaration();
  declared.connections = {wire("u", "y", 9), wire("frame_in", "frame_out", 10),
                          wire("clock_in", "clock_out", 11)};
  const System system(declared);
  REQUIRE(system.connections().size() == 3);
  CHECK(system.full_name(system.connections()[0].from) == "beta.y");
  CHECK(system.full_name(system.connections()[0].to) == "alpha.u");
  CHECK(system.connections()[0].conversion.linear.factor == Approx(1e-3));
  REQUIRE(system.warnings().size() == 3);
  CHECK_THAT(
      system.warnings()[0],
      Contains("s.ssd:9: the connection starts at 'alpha.u', which is input, and ends at "
               "'beta.y', which is output: it is taken for one from 'beta.y' to 'alpha.u'") &&
          Contains("hint: swap start and end"));
  ConnectionDeclaration second = wire("t", "u", 12);
  second.to_component = "alpha";
  declared.connections.push_back(second);
  CHECK_THAT(reason(declared), Contains("'alpha.t' is in 's'"));
  declared.connections.back().suppress_unit_conversion = true;
  CHECK_THAT(reason(declared), Contains("unit 'alpha', variable 'u': this input has two sources: "
                                        "'alpha.t' here and 'beta.y' in line 9"));
}

TEST_CASE("units that do not fit are an error that can be overruled") {
  CHECK_THAT(reason({wire("t", "u")}),
             Contains("'alpha.t' is in 's'") && Contains("suppressUnitConversion"));
  ConnectionDeclaration suppressed = wire("t", "u");
  suppressed.suppress_unit_conversion = true;
  CHECK(reason({suppressed}) == "accepted");
}

TEST_CASE("an input has one source") {
  CHECK_THAT(reason({wire("y", "u", 9), wire("t", "u", 10)}), Contains("'alpha.t' is in 's'"));
  ConnectionDeclaration other = wire("y", "u", 10);
  other.from_component = "beta";
  CHECK_THAT(reason({wire("y", "u", 9), other}),
             Contains("s.ssd:10") && Contains("two sources") && Contains("line 9"));
  ConnectionDeclaration unconverted = wire("y", "u", 10);
  unconverted.suppress_unit_conversion = true;
  CHECK_THAT(reason({wire("y", "u", 9), unconverted}), Contains("two sources"));
}

TEST_CASE("a connection that is there twice is one, with a warning") {
  SystemDeclaration declared = declaration();
  declared.connections = {wire("y", "u", 9), wire("y", "u", 10)};
  const System system(declared);
  CHECK(system.connections().size() == 1);
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0], Contains("s.ssd:10: ") && Contains("'alpha.y' to 'beta.u'") &&
                                       Contains("in line 9") && Contains("ignored"));
}

TEST_CASE("a near name that differs by case only is suggested first") {
  CHECK_THAT(reason({wire("Y", "u")}), Contains("did you mean 'y'?"));
}

TEST_CASE("a message needs its clock wired too") {
  CHECK_THAT(reason({wire("frame_out", "frame_in")}),
             Contains("its clock 'beta.clock_in' is not connected"));
  CHECK(reason({wire("frame_out", "frame_in"), wire("clock_out", "clock_in")}) == "accepted");
}

TEST_CASE("a clock without the values that belong to it is a warning") {
  SystemDeclaration system = declaration();
  system.connections = {wire("clock_out", "clock_in", 9)};
  CHECK_THAT(System(system).warnings().at(0),
             Contains("s.ssd:9: the clock 'alpha.clock_out'") && Contains("brings no data") &&
                 Contains("connect 'alpha.frame_out' to 'beta.frame_in'"));
  system.connections.push_back(wire("frame_out", "frame_in"));
  CHECK(System(system).warnings().empty());
}

TEST_CASE("a value for an input that is connected is a warning if it was asked for by name") {
  SystemDeclaration system = declaration();
  system.connections = {wire("y", "u")};
  system.start_values.emplace_back();
  StartDeclaration& start = system.start_values.back();
  start.component = "beta";
  start.variable = "u";
  start.value = "3";
  start.where = {"--set beta.u=3", 0};
  CHECK_THAT(System(system).warnings().at(0),
             Contains("--set beta.u=3: 'beta.u' is connected to 'alpha.y', whose value replaces"));
  start.is_optional = true;
  CHECK(System(system).warnings().empty());
}

TEST_CASE("what belongs to a triggered clock is a message") {
  const auto unit = description();
  const auto is_message = [&](const std::string& name) {
    return unit->is_message(unit->variables[unit->find(name).value()]);
  };
  CHECK(is_message("frame_in"));
  CHECK(is_message("frame_out"));
  CHECK_FALSE(is_message("u"));
  CHECK_FALSE(is_message("clock_out"));
}

TEST_CASE("what belongs to a time-based clock may be connected to any value but a message") {
  const Interval second = Interval::from_fraction(1, 1);
  const auto sampler = Describe("sampler")
                           .clock("tick", IntervalVariability::Constant, second)
                           .input("in")
                           .clocked_by(0)
                           .output("out")
                           .clocked_by(0)
                           .input("u")
                           .output("y")
                           .add("clock_out", ValueType::Clock, Causality::Output)
                           .output("message_out")
                           .clocked_by(5)
                           .add("clock_in", ValueType::Clock, Causality::Input)
                           .input("message_in")
                           .clocked_by(7)
                           .done();
  const auto with = [&](const std::string& from, const std::string& to) {
    SystemDeclaration system;
    system.components = {{"alpha", sampler, {}, {}}, {"beta", sampler, {}, {}}};
    system.connections = {wire(from, to)};
    return reason(system);
  };
  CHECK(with("out", "in") == "accepted");
  CHECK(with("out", "u") == "accepted");
  CHECK(with("y", "in") == "accepted");
  CHECK_THAT(with("message_out", "in"), Contains("s.ssd:9") &&
                                            Contains("'alpha.message_out' is a message") &&
                                            Contains("to another message"));
  CHECK_THAT(with("out", "message_in"), Contains("'beta.message_in' is a message"));
  CHECK_THAT(with("y", "message_in"), Contains("'beta.message_in' is a message"));
  CHECK_THAT(with("message_out", "u"), Contains("'alpha.message_out' is a message"));
  CHECK_THAT(with("tick", "clock_out"), Contains("'beta.clock_out' is not an input"));
  CHECK_THAT(with("tick", "u"), Contains("Clock and Float64 are different types"));
  for (const char* source : {"clock_out", "y", "tick"}) {
    CHECK_THAT(with(source, "tick"), Contains("s.ssd:9") && Contains("a constant clock") &&
                                         Contains("remove the connection"));
  }
}

TEST_CASE("a time-based clock that is connected to a triggered one makes messages of its outputs") {
  const auto node = Describe("node")
                        .clock("tx", IntervalVariability::Countdown)
                        .output("out")
                        .clocked_by(0)
                        .add("rx", ValueType::Clock, Causality::Input)
                        .input("in")
                        .clocked_by(2)
                        .input("u")
                        .done();
  const auto with = [&](std::vector<ConnectionDeclaration> connections) {
    SystemDeclaration system;
    system.components = {{"alpha", node, {}, {}}, {"beta", node, {}, {}}};
    system.connections = std::move(connections);
    return system;
  };
  CHECK_THAT(reason(with({wire("out", "in")})), Contains("'beta.in' is a message"));
  CHECK_THAT(reason(with({wire("tx", "rx"), wire("out", "u")})),
             Contains("'alpha.out' is a message"));
  const System system(with({wire("tx", "rx"), wire("out", "in")}));
  CHECK(system.ticks_triggered({0, 0}));
  CHECK(system.is_message({0, 1}));
  CHECK((system.is_reported({0, 1}) && !system.is_reported({1, 1})));
  CHECK_FALSE((system.is_reported({0, 0}) || system.is_reported({0, 2})));
  CHECK_FALSE(system.is_sampled({0, 1}));
  CHECK(System(with({{"beta", "rx", "alpha", "tx", false, {}}, wire("out", "in")}))
            .connections()[0]
            .from == VariableId{0, 0});  // either end may be the first
  CHECK_FALSE(system.ticks_triggered({1, 0}));
  CHECK(system.is_sampled({1, 1}));
  CHECK(system.is_signal({1, 1}));
}

TEST_CASE(
    "a time-based clock without outputs is reported where it is connected to a triggered one") {
  const auto node = Describe("node")
                        .clock("tx", IntervalVariability::Countdown)
                        .add("rx", ValueType::Clock, Causality::Input)
                        .done();
  SystemDeclaration declaration;
  declaration.components = {{"alpha", node, {}, {}}, {"beta", node, {}, {}}};
  CHECK_FALSE(System(declaration).is_reported({0, 0}));
  CHECK(System(declaration).is_reported({0, 1}));
  declaration.connections = {wire("tx", "rx")};
  CHECK(System(declaration).is_reported({0, 0}));
  CHECK_FALSE(System(declaration).is_reported({1, 0}));
}

TEST_CASE("a time-based clock needs Event Mode") {
  auto unit = std::make_shared<UnitDescription>(
      *Describe("model").clock("tick", IntervalVariability::Countdown).done());
  unit->has_event_mode = false;
  SystemDeclaration system;
  system.components = {{"alpha", unit, {}, {"s.ssd", 3}}};
  CHECK_THAT(reason(system), Contains("s.ssd:3") && Contains("unit 'alpha', variable 'tick'") &&
                                 Contains("countdown clock") && Contains("hasEventMode"));
}

TEST_CASE("a message needs units with Event Mode, at both ends") {
  const bool at_source = GENERATE(true, false);
  const auto unit = [](bool has_event_mode) {
    auto description =
        std::make_shared<UnitDescription>(*Describe("model")
                                               .add("out", ValueType::Clock, Causality::Output)
                                               .add("in", ValueType::Clock, Causality::Input)
                                               .done());
    description->has_event_mode = has_event_mode;
    return description;
  };
  SystemDeclaration declaration;
  declaration.components = {{"a", unit(!at_source), {}, {}}, {"b", unit(at_source), {}, {}}};
  CHECK_NOTHROW(System(declaration));
  declaration.connections = {{"a", "out", "b", "in", false, {"s.ssd", 9}}};
  CHECK_THROWS_WITH(System(declaration), Contains("s.ssd:9") && Contains("hasEventMode") &&
                                             Contains(at_source ? "unit 'a', variable 'out'"
                                                                : "unit 'b', variable 'in'"));
}

TEST_CASE("two components of one name, and a system without any, are refused") {
  SystemDeclaration twice = declaration();
  twice.components[1].name = "alpha";
  CHECK_THAT(reason(twice), Contains("s.ssd:4") && Contains("two components are named 'alpha'"));
  CHECK_THAT(reason(SystemDeclaration{}), Contains("no component"));
}

TEST_CASE("declared connectors must agree with the unit") {
  const auto with = [](ConnectorDeclaration connector) {
    connector.where = {"s.ssd", 5};
    SystemDeclaration system = declaration();
    system.components[0].connectors = {connector};
    return reason(system);
  };
  CHECK(with({"u", ValueType::Float64, Causality::Input, "m", {}}) == "accepted");
  CHECK_THAT(with({"v", {}, {}, "", {}}), Contains("s.ssd:5") && Contains("no such variable"));
  CHECK_THAT(with({"u", {}, Causality::Output, "", {}}),
             Contains("the connector has output, the unit has input"));
  CHECK_THAT(with({"u", ValueType::Int32, {}, "", {}}),
             Contains("has Int32, the unit has Float64"));
  CHECK_THAT(with({"u", {}, {}, "s", {}}), Contains("the connector is in 's'"));
}

TEST_CASE("a unit that does not fit is explained connector by connector, each of them once") {
  auto system = declaration();
  system.components[1].connectors = {
      {"u", ValueType::Int32, {}, {}, {"s.ssd", 5}},
      {"lamp", ValueType::Boolean, Causality::Output, {}, {"s.ssd", 6}},
      {"height", {}, Causality::Input, {"mm", kMillimetres}, {"s.ssd", 7}}};
  system.connections = {wire("y", "u", 10),
                        wire("y", "height", 11),
                        wire("y", "speed", 12),
                        wire("t", "n", 13),
                        {"beta", "lamp", "alpha", "n", false, {"s.ssd", 14}}};
  CHECK_THAT(
      reason(system),
      StartsWith(
          "there are 5 mistakes:\n"
          "  s.ssd:5: unit 'beta', variable 'u': the connector has Int32, the unit has Float64\n"
          "  s.ssd:6: unit 'beta', variable 'lamp': its model 'model' has no such variable; "
          "expected an output Boolean for 'alpha.n'\n"
          "  s.ssd:7: unit 'beta', variable 'height': its model 'model' has no such variable; "
          "expected an input Float64 in mm, fed by 'alpha.y'\n"
          "  s.ssd:12: unit 'beta', variable 'speed': its model 'model' has no such variable; "
          "expected an input Float64 in mm, fed by 'alpha.y'\n"
          "  s.ssd:13: cannot connect 'alpha.t' to 'beta.n': Float64 and Int32 are different "
          "types"));
}

TEST_CASE("a unit that lacks variables is summed up above them") {
  auto system = declaration();
  system.components[1].where = {"s.ssd", 3};
  system.components[1].connectors = {{"lamp", {}, {}, {}, {"s.ssd", 5}}};
  system.connections = {wire("y", "speed", 12)};
  CHECK_THAT(reason(system),
             StartsWith("s.ssd:3: unit 'beta': 2 things do not fit; its model 'model' has none of "
                        "the 2 variables that are expected:\n  s.ssd:5: variable 'lamp': "));
  system.connections.push_back(wire("y", "u", 13));
  system.connections.push_back({"beta", "lamp", "alpha", "n", false, {"s.ssd", 14}});
  CHECK_THAT(reason(system), StartsWith("s.ssd:3: unit 'beta': 2 things do not fit; its model "
                                        "'model' has 1 of the 3 variables that are expected:\n"));
}

TEST_CASE("the dimensions of a value must be those of the variable") {
  const auto pair_of = [](std::vector<DimensionDeclaration> dimensions) {
    SystemDeclaration system = declaration();
    system.start_values = {{"beta", "trio", "1 2 3", {}, {"s.ssd", 12}}};
    system.start_values[0].dimensions = std::move(dimensions);
    return reason(system);
  };
  CHECK(pair_of({{3, ""}}) == "accepted");
  CHECK(pair_of({{std::nullopt, "n"}}) == "accepted");
  CHECK_THAT(pair_of({{2, ""}}), StartsWith("s.ssd:12: ") &&
                                     Contains("the value has the dimensions 2, the variable is an "
                                              "array of 3 elements"));
  CHECK_THAT(pair_of({{1, ""}, {3, ""}}), Contains("the dimensions 1 × 3"));
}

TEST_CASE("two variables of one name are a warning") {
  SystemDeclaration system = declaration();
  system.components = {{"a", Describe("m").output("b.y").output("y").done(), {}, {"s.ssd", 3}},
                       {"a.b", Describe("n").output("y").done(), {}, {"s.ssd", 4}}};
  const std::vector<std::string> warnings = System(system).warnings();
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], StartsWith("s.ssd:4: two variables are named 'a.b.y'") &&
                              Contains("'b.y' of the component 'a' in line 3"));
}

TEST_CASE("wrong start values are reported together") {
  auto system = declaration();
  system.start_values = {{"alpha", "gain", "high", {}, {"s.ssd", 5}},
                         {"alpha", "ranged", "3", {}, {"s.ssd", 6}},
                         {"beta", "y", "1", {}, {"s.ssd", 7}}};
  CHECK_THAT(reason(system), Contains("3 mistakes") &&
                                 Contains("s.ssd:5: unit 'alpha', variable 'gain'") &&
                                 Contains("s.ssd:6: unit 'alpha', variable 'ranged'") &&
                                 Contains("s.ssd:7: unit 'beta', variable 'y'"));
}

TEST_CASE("of many start values without a variable, the first ones are named") {
  auto system = declaration();
  for (int i = 0; i < 1100; ++i) {
    StartDeclaration start{"alpha", fmt::format("gain{}", i), "1", {}, {"s.ssd", 5}};
    start.is_optional = true;
    system.start_values.push_back(start);
  }
  const std::vector<std::string> warnings = System{system}.warnings();
  REQUIRE(warnings.size() == 21);
  CHECK_THAT(warnings[19], Contains("variable 'gain19'") && Contains("did you mean 'gain'?"));
  CHECK_THAT(warnings[20], StartsWith("… and 1080 more values"));
}

TEST_CASE("start values are converted, parsed and refused where they cannot be set") {
  const auto with = [](StartDeclaration start) {
    start.where = {"s.ssd", 12};
    SystemDeclaration system = declaration();
    system.start_values = {start};
    return reason(system);
  };
  CHECK_THAT(with({"beta", "gain", "big", "", {}}), Contains("expected a Float64 number"));
  CHECK_THAT(with({"beta", "clock_in", "true", "", {}}), Contains("cannot be set"));
  CHECK_THAT(with({"beta", "y", "1", "", {}}), Contains("initial = calculated cannot be set"));
  CHECK_THAT(with({"beta", "ranged", "-1", "", {}}),
             Contains("-1 is out of range, expected at least 0"));
  CHECK_THAT(with({"beta", "ranged", "2.5", "", {}}),
             Contains("2.5 is out of range, expected at most 2"));
  CHECK_THAT(with({"beta", "ranged", "nan", "", {}}),
             Contains("nan is out of range, expected a number"));
  CHECK(with({"beta", "ranged", "2", "", {}}) == "accepted");
  CHECK(with({"beta", "gain", "NaN", "", {}}) == "accepted");
  CHECK_THAT(with({"beta", "u", "1", "s", {}}), Contains("the value is in 's'"));
  SystemDeclaration declared = declaration();
  declared.start_values = {{"beta", "u", "1500", "mm", {}}};
  const System system(declared);
  CHECK(system.start_values()[0].value.numbers<double>()[0] == Approx(1.5));
  declared.start_values = {{"beta", "short", "1500", "mm", {}}};
  const System with_float(declared);
  CHECK(with_float.start_values()[0].value.numbers<float>()[0] == Approx(1.5F));
}

TEST_CASE("a start value as other tools write it is taken, with a warning") {
  SystemDeclaration declared = declaration();
  declared.start_values = {{"beta", "n", "2.0", {}, {"s.ssd", 12}}};
  const System system(declared);
  CHECK(system.start_values()[0].value.numbers<std::int32_t>()[0] == 2);
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0],
             Contains("s.ssd:12: unit 'beta', variable 'n': '2.0' is taken for 2"));
}

// ---- Elements of arrays ----

namespace {

std::shared_ptr<const UnitDescription> with_arrays() {
  return Describe("arrays")
      .unit("m", kMetres)
      .unit("mm", kMillimetres)
      .input("u", "m")
      .size(3)
      .output("y", "mm")
      .size(3)
      .add("flags", ValueType::Boolean, Causality::Input)
      .size(2)
      .add("clock", ValueType::Clock, Causality::Output)
      .add("frames", ValueType::Binary, Causality::Output)
      .size(2)
      .clocked_by(3)
      .done();
}

std::shared_ptr<const UnitDescription> with_scalars() {
  return Describe("scalars")
      .unit("m", kMetres)
      .output("y[3]", "m")
      .output("y[1]", "m")
      .output("y[2]", "m")
      .input("u[1]", "m")
      .input("u[2]", "m")
      .input("u[3]", "m")
      .input("v[1]", "m")
      .input("v[2]", "m")
      .add("flag", ValueType::Boolean, Causality::Output)
      .add("frame", ValueType::Binary, Causality::Input)
      .done();
}

ConnectionDeclaration from_to(const std::string& from, const std::string& to, int line = 9) {
  const auto split = [](const std::string& name) {
    const std::size_t dot = name.find('.');
    return std::pair(name.substr(0, dot), name.substr(dot + 1));
  };
  return {split(from).first, split(from).second, split(to).first, split(to).second, false,
          {"s.ssd", line}};
}

SystemDeclaration arrays_and_scalars(std::vector<ConnectionDeclaration> connections) {
  SystemDeclaration system;
  system.name = "elements";
  system.components = {{"a", with_arrays(), {}, {"s.ssd", 3}},
                       {"b", with_arrays(), {}, {"s.ssd", 4}},
                       {"s", with_scalars(), {}, {"s.ssd", 5}}};
  system.connections = std::move(connections);
  return system;
}

/// "a.y[1]>s.u[1] × 0.001", sorted by target.
std::vector<std::string> made(std::vector<ConnectionDeclaration> connections) {
  const System system(arrays_and_scalars(std::move(connections)));
  std::vector<std::string> texts;
  for (const Connection& connection : system.connections()) {
    texts.push_back(fmt::format("{}>{} × {}", system.range_name(connection.source()),
                                system.range_name(connection.target()),
                                connection.conversion.linear.factor));
  }
  return texts;
}

using WireTexts = std::vector<std::string>;

}  // namespace

TEST_CASE("an element of an array is connected by its name, and converted") {
  CHECK(made({from_to("a.y[2]", "s.u[1]"), from_to("s.y[3]", "b.u[1]"), from_to("a.y[1]", "b.u[3]"),
              from_to("s.flag", "a.flags[2]")}) ==
        WireTexts{"s.flag>a.flags[2] × 1", "s.y[3]>b.u[1] × 1", "a.y[1]>b.u[3] × 0.001",
                  "a.y[2]>s.u[1] × 0.001"});
}

TEST_CASE("an array is connected to scalars that are its elements, and these to it") {
  CHECK(made({from_to("a.y", "s.u"), from_to("s.y", "b.u")}) ==
        WireTexts{"s.y[1]>b.u[1] × 1", "s.y[2]>b.u[2] × 1", "s.y[3]>b.u[3] × 1",
                  "a.y[1]>s.u[1] × 0.001", "a.y[2]>s.u[2] × 0.001", "a.y[3]>s.u[3] × 0.001"});
  CHECK(made({from_to("s.y", "s.u")}) ==
        WireTexts{"s.y[1]>s.u[1] × 1", "s.y[2]>s.u[2] × 1", "s.y[3]>s.u[3] × 1"});
  CHECK(made({from_to("a.y", "b.u")}) == WireTexts{"a.y>b.u × 0.001"});
}

TEST_CASE("elements without a connection are known") {
  const System system(arrays_and_scalars(
      {from_to("s.y[1]", "a.u[2]"), from_to("s.y", "b.u"), from_to("s.flag", "b.flags[2]")}));
  const VariableId a_u{0, 0}, b_u{1, 0}, b_flags{1, 2};
  CHECK(system.partly_connected_inputs() == std::vector<VariableId>{a_u, b_flags});
  CHECK(system.unconnected_elements(a_u) == std::vector<ElementRange>{{a_u, 0, 1}, {a_u, 2, 1}});
  CHECK(system.unconnected_elements(b_u).empty());
  CHECK(system.unconnected_elements(b_flags) == std::vector<ElementRange>{{b_flags, 0, 1}});
}

TEST_CASE("parts of arrays that do not fit are errors") {
  const auto reason_of = [](std::vector<ConnectionDeclaration> connections) {
    return reason(arrays_and_scalars(std::move(connections)));
  };
  CHECK_THAT(reason_of({from_to("a.y[4]", "s.u[1]")}),
             StartsWith("s.ssd:9: unit 'a', variable 'y[4]': 'y' is an array of 3 elements, and "
                        "the index 4 in [4] is not from 1 to 3"));
  CHECK_THAT(reason_of({from_to("a.y[0]", "s.u[1]")}), Contains("indices start at 1"));
  CHECK_THAT(reason_of({from_to("a.y", "s.u[1]")}),
             Contains("cannot connect 'a.y' to 's.u[1]': an array of 3 elements and a scalar") &&
                 Contains("such as 'x[1]'"));
  CHECK_THAT(reason_of({from_to("a.y", "s.v")}),
             Contains("'a.y' to 's.v': an array of 3 elements and scalars of 2 elements"));
  CHECK_THAT(reason_of({from_to("a.y", "s.w")}), Contains("has no such variable"));
  CHECK_THAT(reason_of({from_to("a.y[1]", "b.y[2]")}),
             Contains("cannot connect 'a.y[1]' to 'b.y[2]': 'b.y[2]' is not an input"));
}

TEST_CASE("an element has one source, which may be that of the whole array") {
  const auto reason_of = [](std::vector<ConnectionDeclaration> connections) {
    return reason(arrays_and_scalars(std::move(connections)));
  };
  CHECK_THAT(reason_of({from_to("s.y[1]", "a.u[2]", 7), from_to("s.y[2]", "a.u[2]", 8)}),
             StartsWith("s.ssd:8: unit 'a', variable 'u[2]': this input has two sources: 's.y[2]' "
                        "here and 's.y[1]' in line 7"));
  CHECK_THAT(reason_of({from_to("b.y", "a.u", 7), from_to("s.y[2]", "a.u[3]", 8)}),
             StartsWith("s.ssd:8: unit 'a', variable 'u[3]': this input has two sources: 's.y[2]' "
                        "here and 'b.y' in line 7, for 'a.u'"));
  CHECK_THAT(reason_of({from_to("s.y[2]", "a.u[3]", 7), from_to("b.y", "a.u", 8)}),
             Contains("'b.y' here and 's.y[2]' in line 7, for 'a.u[3]'"));
  CHECK_THAT(reason_of({from_to("s.y[2]", "a.u[1]", 7), from_to("s.y", "a.u", 8)}),
             Contains("'s.y[1]' here and 's.y[2]' in line 7"));
  const System twice(
      arrays_and_scalars({from_to("s.y[1]", "a.u[2]", 7), from_to("s.y[1]", "a.u[2]", 8)}));
  CHECK(twice.connections().size() == 1);
  REQUIRE(twice.warnings().size() == 1);
  CHECK_THAT(twice.warnings()[0], Contains("'s.y[1]' to 'a.u[2]' is there already, in line 7"));
}

TEST_CASE("a message is not taken apart") {
  CHECK_THAT(reason(arrays_and_scalars({from_to("a.frames[1]", "s.frame")})),
             Contains("'a.frames' is a message, which is sent and received as a whole"));
}

TEST_CASE("elements of a continuous input are connected to clocked outputs all, or none") {
  SystemDeclaration system = arrays_and_scalars({});
  system.components.push_back({"c",
                               Describe("sampler")
                                   .clock("tick", IntervalVariability::Constant, Interval{})
                                   .output("y", "m")
                                   .clocked_by(0)
                                   .done(),
                               {},
                               {"s.ssd", 6}});
  system.connections = {from_to("s.y[1]", "a.u[1]", 7), from_to("c.y", "a.u[3]", 8)};
  CHECK_THAT(reason(system),
             StartsWith("s.ssd:8: unit 'a', variable 'u': 'c.y', which belongs to a clock, is "
                        "connected to 'a.u[3]', and 's.y[1]', which does not, to 'a.u[1]' in line "
                        "7"));
  system.connections = {from_to("c.y", "a.u[1]", 7), from_to("c.y", "a.u[3]", 8)};
  CHECK(reason(system) == "accepted");
}

TEST_CASE("declared connectors may be elements, and their dimensions are checked") {
  SystemDeclaration system = arrays_and_scalars({from_to("a.y", "s.u")});
  const auto declare = [&](const std::string& name, std::vector<DimensionDeclaration> dimensions) {
    ConnectorDeclaration connector{name, ValueType::Float64, {}, {}, {"s.ssd", 6}};
    connector.dimensions = std::move(dimensions);
    return connector;
  };
  const auto reason_with = [&](std::size_t component, const ConnectorDeclaration& connector) {
    system.components[component].connectors = {connector};
    std::string text = reason(system);
    system.components[component].connectors.clear();
    return text;
  };
  CHECK(reason_with(0, declare("y[2]", {})) == "accepted");
  CHECK(reason_with(0, declare("y", {{3, ""}})) == "accepted");
  CHECK(reason_with(0, declare("y", {{{}, "n"}})) == "accepted");
  CHECK(reason_with(2, declare("u", {{3, ""}})) == "accepted");
  CHECK_THAT(reason_with(0, declare("y[4]", {})), Contains("the index 4 in [4]"));
  CHECK_THAT(reason_with(0, declare("y", {{2, ""}})),
             StartsWith("s.ssd:6: unit 'a', variable 'y': the connector has the dimensions 2, the "
                        "unit has 3"));
  CHECK_THAT(reason_with(0, declare("y", {{3, ""}, {{}, "n"}})),
             Contains("3 × 'n', the unit has 3"));
  CHECK_THAT(reason_with(2, declare("y[1]", {{3, ""}})), Contains("the unit has a scalar"));
}

TEST_CASE("a warning that a value is replaced is for what is connected as a whole") {
  SystemDeclaration system =
      arrays_and_scalars({from_to("s.y[1]", "a.u[2]"), from_to("s.y", "b.u")});
  system.start_values = {{"a", "u", "1 2 3", {}, {"--set", 0}},
                         {"b", "u", "1 2 3", {}, {"--set", 0}}};
  const System built(system);
  REQUIRE(built.warnings().size() == 1);
  CHECK_THAT(built.warnings()[0], Contains("'b.u' is connected to 's.y[1]'"));
}

// ---- Start values of elements ----

namespace {

/// "a.u = 1 _ 3" where nothing is given for the second element, in the order of the values.
std::vector<std::string> start_texts(const System& system) {
  std::vector<std::string> texts;
  for (const StartValue& start : system.start_values()) {
    std::string text = system.full_name(start.id) + " =";
    for (std::size_t i = 0; i < start.value.size(); ++i) {
      const bool is_kept = std::ranges::count(start.kept, i) > 0;
      text += " " + (is_kept ? "_" : element_text(start.value, i));
    }
    texts.push_back(text);
  }
  return texts;
}

StartDeclaration start_of(const std::string& component, const std::string& variable,
                          const std::string& value, bool is_optional = false) {
  StartDeclaration start{component, variable, value, {}, {"s.ssd", 8}};
  start.is_optional = is_optional;
  return start;
}

std::vector<std::string> given(std::vector<StartDeclaration> starts) {
  SystemDeclaration system = arrays_and_scalars({});
  system.start_values = std::move(starts);
  return start_texts(System(system));
}

std::string mistake_of(StartDeclaration start) {
  SystemDeclaration system = arrays_and_scalars({});
  system.start_values = {std::move(start)};
  return reason(system);
}

}  // namespace

TEST_CASE("start values of elements make one of their array, whose others keep the unit's") {
  CHECK(given({start_of("a", "u[3]", "7"), start_of("a", "u[1]", "5")}) ==
        WireTexts{"a.u = 5 _ 7"});
  CHECK(given({start_of("a", "u", "1 2 3"), start_of("a", "u[2]", "5")}) ==
        WireTexts{"a.u = 1 5 3"});
  CHECK(given({start_of("a", "u[2]", "5"), start_of("a", "u", "1 2 3")}) ==
        WireTexts{"a.u = 1 2 3"});
  CHECK(given({start_of("a", "flags[2]", "true")}) == WireTexts{"a.flags = _ true"});
  StartDeclaration converted = start_of("a", "u[2]", "1500");
  converted.unit = {"mm", kMillimetres};
  CHECK(given({converted}) == WireTexts{"a.u = _ 1.5 _"});
  converted.via = {{{"i", ValueType::Float64, {"mm", kMillimetres}, {}, true}, {}}};
  CHECK(given({converted}) == WireTexts{"a.u = _ 1.5 _"});
}

TEST_CASE("the value of an array whose elements are scalars is that of each of them") {
  CHECK(given({start_of("s", "u", "1 2 3"), start_of("s", "u[2]", "5")}) ==
        WireTexts{"s.u[1] = 1", "s.u[2] = 5", "s.u[3] = 3"});
  CHECK_THAT(mistake_of(start_of("s", "u", "1 2")),
             StartsWith("s.ssd:8: unit 's', variable 'u': '1 2' is not a value for it, expected 3 "
                        "Float64 values separated by blanks"));
}

TEST_CASE("a start value for an element that the array does not have is an error") {
  const bool is_optional = GENERATE(false, true);
  CHECK_THAT(mistake_of(start_of("a", "u[4]", "7", is_optional)),
             StartsWith("s.ssd:8: unit 'a', variable 'u[4]': 'u' is an array of 3 elements, and "
                        "the index 4 in [4] is not from 1 to 3"));
  CHECK_THAT(mistake_of(start_of("a", "u[0]", "7", is_optional)), Contains("indices start at 1"));
  CHECK_THAT(mistake_of(start_of("a", "u[2]", "7 8", is_optional)),
             Contains("variable 'u[2]': '7 8' is not a value for it, expected one Float64 value"));
}

TEST_CASE("elements are those of the sizes that structural parameters give, in any order") {
  const auto resizable = Describe("resizable")
                             .add("n", ValueType::UInt64, Causality::StructuralParameter)
                             .exact()
                             .input("u")
                             .size(2)
                             .done();
  UnitDescription unit = *resizable;
  unit.variables[0].variability = Variability::Fixed;
  unit.variables[1].dimensions = {Dimension(2, ValueReference{0})};
  SystemDeclaration system;
  system.components = {{"r", std::make_shared<const UnitDescription>(unit), {}, {"s.ssd", 3}}};
  system.start_values = {start_of("r", "u[3]", "7"), start_of("r", "n", "4")};
  CHECK(start_texts(System(system)) == WireTexts{"r.u = _ _ 7 _"});
  system.start_values.back().value = "1";
  CHECK_THAT(reason(system), Contains("'u' is an array of 1 element, and the index 3"));
}

TEST_CASE("what is kept of a start value is the unit's own") {
  SystemDeclaration declared = arrays_and_scalars({});
  declared.start_values = {start_of("a", "u[2]", "5")};
  const System system(declared);
  const ValueBlock own = parse(system.variable({0, 0}), "10 20 30");
  CHECK(system.start_values().at(0).over(own) == parse(system.variable({0, 0}), "10 5 30"));
}

TEST_CASE("a warning that a value of an element is replaced is for what is connected") {
  SystemDeclaration system = arrays_and_scalars({from_to("s.y[1]", "a.u[2]")});
  system.start_values = {start_of("a", "u[1]", "1"), start_of("a", "u[2]", "2")};
  const System built(system);
  REQUIRE(built.warnings().size() == 1);
  CHECK_THAT(built.warnings()[0], Contains("'a.u[2]' is connected to 's.y[1]'"));
  system.connections = {from_to("a.y", "s.u")};
  system.start_values = {start_of("s", "u", "1 2 3")};
  CHECK_THAT(System(system).warnings().at(0), Contains("'s.u' is connected to 'a.y[1]'"));
}

// ---- Connectors of systems ----

TEST_CASE("connectors of systems have as many elements as what they are connected to") {
  const auto via = [](std::vector<DimensionDeclaration> dimensions) {
    return std::vector<ViaDeclaration>{{{"s.o", {}, {}, {}, false}, {}, dimensions, {"s.ssd", 7}}};
  };
  const auto of_connection = [&](const std::string& from, const std::string& to,
                                 std::vector<DimensionDeclaration> dimensions) {
    SystemDeclaration system = arrays_and_scalars({from_to(from, to), from_to("a.y", "b.u")});
    system.connections[0].via = via(std::move(dimensions));
    return reason(system);
  };
  CHECK(of_connection("a.y", "s.u", {{3, ""}}) == "accepted");
  CHECK(of_connection("a.y", "s.u", {}) == "accepted");
  CHECK(of_connection("a.y", "s.u", {{{}, "n"}}) == "accepted");
  CHECK_THAT(of_connection("a.y", "s.u", {{2, ""}, {2, ""}}),
             StartsWith("s.ssd:7: the connector 's.o' of a system has the dimensions 2 × 2, and "
                        "'a.y', which it is connected to, is an array of 3 elements"));
  CHECK_THAT(of_connection("a.y[1]", "s.u[1]", {{3, ""}}),
             Contains("'a.y[1]'") && Contains("is a scalar"));
  CHECK_THAT(of_connection("s.y", "a.u", {{2, ""}}),
             Contains("'s.y', which it is connected to, is scalars of 3 elements"));

  SystemDeclaration twice = arrays_and_scalars({from_to("a.y", "s.u"), from_to("a.y", "b.u")});
  twice.connections[0].via = twice.connections[1].via = via({{2, ""}});
  CHECK_THAT(reason(twice), StartsWith("s.ssd:7: the connector 's.o'"));

  SystemDeclaration open = arrays_and_scalars({});
  open.inputs = {{"a", "u", via({{4, ""}}), {"s.ssd", 9}}};
  CHECK_THAT(reason(open), StartsWith("s.ssd:7: the connector 's.o'") && Contains("'a.u'"));
  open.inputs = {};
  open.outputs = {{"a", "y", via({{4, ""}}), {"s.ssd", 9}}};
  CHECK_THAT(reason(open), StartsWith("s.ssd:7: the connector 's.o'") && Contains("'a.y'"));
}

TEST_CASE("an input of the system leads to what is there, and a wrong end is reported once") {
  SystemDeclaration system = arrays_and_scalars({});
  system.inputs = {{"a", "u[4]", {}, {"s.ssd", 9}}};
  system.start_values = {start_of("a", "u[4]", "7", true)};
  CHECK_THAT(reason(system),
             StartsWith("s.ssd:9: unit 'a', variable 'u[4]': 'u' is an array of 3"));
  system.inputs = {{"a", "w", {}, {"s.ssd", 9}}};
  system.start_values = {start_of("a", "w", "7", true)};
  CHECK_THAT(reason(system), StartsWith("s.ssd:9: unit 'a', variable 'w': its model 'arrays' has "
                                        "no such variable\n"));
}

// ---- Units of measure ----

namespace {

const BaseUnitOfMeasure kKelvin{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0};
const BaseUnitOfMeasure kCelsius{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15L};

/// With the outputs `t` and `rise`, the inputs `k` and `step`; `rise` and `step` are differences.
std::shared_ptr<const UnitDescription> thermal() {
  auto unit = std::make_shared<UnitDescription>(*Describe("thermal")
                                                     .unit("K", kKelvin)
                                                     .unit("degC", kCelsius)
                                                     .output("t", "degC")
                                                     .output("rise", "degC")
                                                     .input("k", "K")
                                                     .input("step", "K")
                                                     .input("bare")
                                                     .input("odd", "league")
                                                     .done());
  unit->variables[1].is_relative = unit->variables[3].is_relative = true;
  return unit;
}

std::shared_ptr<const UnitDescription> thermal_with_output(const std::string& name) {
  auto unit = std::make_shared<UnitDescription>(*thermal());
  unit->variables[*unit->find(name)].causality = Causality::Output;
  return unit;
}

SystemDeclaration thermal_system(std::vector<ConnectionDeclaration> connections) {
  SystemDeclaration system;
  system.name = "thermal";
  system.components = {{"a", thermal(), {}, {"s.ssd", 3}}, {"b", thermal(), {}, {"s.ssd", 4}}};
  system.connections = std::move(connections);
  return system;
}

LinearConversion only_conversion(const System& system) {
  REQUIRE(system.connections().size() == 1);
  return system.connections()[0].conversion.linear;
}

}  // namespace

TEST_CASE("a difference is converted without the offset of its unit") {
  const System difference(thermal_system({from_to("a.rise", "b.step")}));
  CHECK(only_conversion(difference).is_identity());
  CHECK(difference.warnings().empty());
  const System absolute(thermal_system({from_to("a.t", "b.k")}));
  CHECK(only_conversion(absolute) == LinearConversion{1, 273.15});
}

TEST_CASE("where one end alone is a difference, the value is one, with a warning") {
  const auto [from, to] =
      GENERATE(table<const char*, const char*>({{"a.rise", "b.k"}, {"a.t", "b.step"}}));
  const System system(thermal_system({from_to(from, to)}));
  CHECK(only_conversion(system).is_identity());
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0], Contains("s.ssd:9: ") && Contains("relativeQuantity") &&
                                       Contains("from 'degC' to 'K'"));
  ConnectionDeclaration wanted = from_to(from, to);
  wanted.suppress_unit_conversion = true;
  CHECK(System(thermal_system({wanted})).warnings().empty());
}

namespace {

/// For the input `k` of `b`, in K, through connectors of systems.
StartDeclaration through(const std::string& value, const UnitOfMeasure& unit,
                         std::vector<ViaDeclaration> via) {
  StartDeclaration start{"b", "k", value, unit, {"s.ssd", 12}};
  start.via = std::move(via);
  return start;
}

ViaDeclaration system_connector(const std::string& name, const UnitOfMeasure& unit = {}) {
  return {{name, ValueType::Float64, unit, {}, true}, {}};
}

double first_start(const SystemDeclaration& declared) {
  return System(declared).start_values().at(0).value.numbers<double>()[0];
}

}  // namespace

TEST_CASE("a value for a connector of a system without a unit is in that of the one behind it") {
  const UnitOfMeasure celsius{"degC", kCelsius}, kelvin{"K", kKelvin};
  SystemDeclaration declared = thermal_system({});
  declared.components[1].connectors = {
      {"k", ValueType::Float64, Causality::Input, celsius, {"s.ssd", 6}}};
  const auto with = [&](const UnitOfMeasure& unit, std::vector<ViaDeclaration> via) {
    declared.start_values = {through("10", unit, std::move(via))};
    return first_start(declared);
  };
  CHECK(with({}, {system_connector("T")}) == 283.15);
  CHECK(with({}, {system_connector("T"), system_connector("s.T")}) == 283.15);
  CHECK(with(celsius, {system_connector("T")}) == 283.15);
  CHECK(with(kelvin, {system_connector("T")}) == 10);
  CHECK(with({}, {system_connector("T", kelvin)}) == 10);
  CHECK(with({}, {}) == 10);  // for the variable itself
  declared.start_values[0].via = {system_connector("T")};
  declared.start_values[0].suppress_unit_conversion = true;  // up to the component's connector
  CHECK(first_start(declared) == 283.15);
  declared.start_values = {through("hot", {}, {system_connector("T")})};
  declared.start_values[0].value = "10degF";
  CHECK_THAT(reason(declared), Contains("a number in 'degC'") && Contains(": -12.2"));
}

TEST_CASE("connectors of different units of measure behind one of a system are a warning") {
  SystemDeclaration declared = thermal_system({});
  declared.components[1].connectors = {
      {"k", ValueType::Float64, Causality::Input, {"degC", kCelsius}, {"s.ssd", 6}}};
  const auto starts = [](const ViaDeclaration& via) {
    StartDeclaration other = through("10", {}, {via});
    other.component = "a";
    return std::vector{other, through("10", {}, {via})};
  };
  declared.start_values = starts(system_connector("T"));
  const System system(declared);
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0],
             StartsWith("s.ssd:12: the connector 'T' has no unit of measure") &&
                 Contains("'a.k' takes the value in 'K', and 'b.k' in 'degC'"));
  declared.start_values = starts(system_connector("T", {"K", kKelvin}));
  CHECK(System(declared).warnings().empty());
  declared.start_values = starts(system_connector("T"));
  declared.start_values[1].component = "a";
  CHECK(System(declared).warnings().empty());
}

TEST_CASE("the warning for a difference names the units of measure on the way") {
  SystemDeclaration declared = thermal_system({from_to("a.bare", "b.step")});
  declared.components[0].description = thermal_with_output("bare");
  declared.connections[0].via = {system_connector("s.y", {"degC", kCelsius})};
  const System system(declared);
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0], Contains("converted from 'degC' to 'K'"));
}

TEST_CASE("a unit of measure for what has none is a warning") {
  SystemDeclaration declared = declaration();
  declared.start_values = {{"beta", "n", "2", {"mm", kMillimetres}, {"s.ssd", 12}}};
  const System system(declared);
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(
      system.warnings()[0],
      StartsWith("s.ssd:12: unit 'beta', variable 'n': the unit of measure 'mm' of the value "
                 "is ignored: the variable is an Int32"));
}

TEST_CASE("a connection whose conversion is suppressed is marked where it matters") {
  ConnectionDeclaration suppressed = from_to("a.t", "b.k");
  suppressed.suppress_unit_conversion = true;
  CHECK(System(thermal_system({suppressed})).connections()[0].keeps_number);
  CHECK(!System(thermal_system({from_to("a.t", "b.k")})).connections()[0].keeps_number);
  suppressed.to_connector = "bare";
  CHECK(!System(thermal_system({suppressed})).connections()[0].keeps_number);
}

// ---- Precedence ----

namespace {

/// With the parameters `x` and `y`, which share their value, and `minus`, which has its negative.
SystemDeclaration with_aliases(std::vector<StartDeclaration> starts) {
  auto unit =
      std::make_shared<UnitDescription>(*Describe("aliases")
                                             .add("x", ValueType::Float64, Causality::Parameter)
                                             .add("y", ValueType::Float64, Causality::Parameter)
                                             .add("minus", ValueType::Float64, Causality::Parameter)
                                             .done());
  unit->variables[1].shares_value_of = unit->variables[2].shares_value_of = 0;
  unit->variables[2].is_negated = true;
  SystemDeclaration system;
  system.name = "aliases";
  system.components = {{"a", unit, {}, {"s.ssd", 3}}};
  system.start_values = std::move(starts);
  return system;
}

StartDeclaration ranked(const std::string& variable, const std::string& value, int line,
                        std::size_t rank, bool is_optional = true) {
  StartDeclaration start{"a", variable, value, {}, {"p.ssv", line}};
  start.rank = rank;
  start.is_optional = is_optional;
  return start;
}

}  // namespace

TEST_CASE("of values for variables that share theirs, the one with precedence counts") {
  const auto [first, second] =
      GENERATE(table<const char*, const char*>({{"x", "y"}, {"y", "x"}, {"minus", "x"}}));
  const System system(with_aliases({ranked(first, "1", 4, 1), ranked(second, "2", 5, 2)}));
  REQUIRE(system.start_values().size() == 1);
  const StartValue& start = system.start_values()[0];
  CHECK(system.variable(start.id).name == second);
  CHECK(start.value.numbers<double>()[0] == 2);
  CHECK(system.warnings().empty());
}

TEST_CASE("values of one set that contradict each other are an error") {
  CHECK_THAT(reason(with_aliases({ranked("x", "1", 4, 1), ranked("y", "2", 5, 1)})),
             StartsWith("p.ssv:5: unit 'a', variable 'y': two values of one parameter set "
                        "contradict each other: 'a.y' has the value 2 here, and 'a.x' 1 in "
                        "p.ssv:4; both are names of one variable"));
  CHECK(reason(with_aliases({ranked("x", "1", 4, 1), ranked("y", "1.0", 5, 1)})) == "accepted");
  CHECK(reason(with_aliases({ranked("x", "1", 4, 1), ranked("minus", "-1", 5, 1)})) == "accepted");
  CHECK_THAT(reason(with_aliases({ranked("x", "1", 4, 1), ranked("minus", "1", 5, 1)})),
             Contains("contradict each other"));
  SystemDeclaration arrays = arrays_and_scalars({});
  arrays.start_values = {ranked("u", "1 2 3", 4, 1), ranked("u[2]", "5", 5, 1)};
  CHECK_THAT(reason(arrays), Contains("'a.u[2]' has the value 5 here, and 'a.u' 1 2 3 in p.ssv:4"));
  arrays.start_values[1].value = "2";
  CHECK(reason(arrays) == "accepted");
  arrays.start_values = {ranked("u[2]", "5", 4, 1), ranked("u[3]", "6", 5, 1)};
  CHECK(reason(arrays) == "accepted");
}

TEST_CASE("values of the command line for two names of one variable are a warning") {
  const System system(with_aliases({ranked("x", "1", 0, 1, false), ranked("y", "2", 0, 2, false)}));
  REQUIRE(system.warnings().size() == 1);
  CHECK_THAT(system.warnings()[0],
             Contains("both are names of one variable") && Contains("the later one is used"));
}

TEST_CASE("a start value of a difference is one") {
  SystemDeclaration declared = thermal_system({});
  declared.start_values = {{"b", "step", "10", {"degC", kCelsius}, {"s.ssd", 12}},
                           {"b", "k", "10", {"degC", kCelsius}, {"s.ssd", 13}}};
  const System system(declared);
  REQUIRE(system.start_values().size() == 2);
  CHECK(system.start_values()[0].value.numbers<double>()[0] == 283.15);
  CHECK(system.start_values()[1].value.numbers<double>()[0] == 10);
}

TEST_CASE("an unnamed unit is the connector's, an undefined one the scenario's") {
  SystemDeclaration declared = thermal_system({});
  declared.components[0].connectors = {
      {"bare", ValueType::Float64, Causality::Input, {"degC", {}}, {"s.ssd", 5}},
      {"odd", ValueType::Float64, Causality::Input, {"km", {}}, {"s.ssd", 6}}};
  CHECK_THAT(reason(declared),
             Contains("the connector is in 'km', the unit's variable in 'league'"));
  declared.components[0].units_of_measure = std::make_shared<const UnitsOfMeasure>(
      UnitsOfMeasure{{"league", {{0, 1, 0, 0, 0, 0, 0, 0}, 4828.032L, 0}}});
  const System system(declared);
  const auto unit_of = [&](std::size_t component, const char* name) {
    const UnitDescription& unit = *system.components()[component].description;
    return unit.variables[unit.find(name).value()].unit;
  };
  CHECK(unit_of(0, "bare") == "degC");
  CHECK(unit_of(1, "bare").empty());
  CHECK(unit_of(0, "odd") == "league");
}

TEST_CASE("a connection has the units of measure that connectors declare, not their variables'") {
  SystemDeclaration declared = thermal_system({from_to("a.t", "b.bare")});
  CHECK(only_conversion(System(declared)).is_identity());
  declared.components[0].connectors = {
      {"t", ValueType::Float64, Causality::Output, {"K", {}}, {"s.ssd", 5}}};
  CHECK(only_conversion(System(declared)) == LinearConversion{1, 273.15});
  declared.connections = {from_to("a.t", "b.k")};
  CHECK(only_conversion(System(declared)) == LinearConversion{1, 273.15});
  declared.connections[0].suppress_unit_conversion = true;
  CHECK(only_conversion(System(declared)) == LinearConversion{1, 273.15});
  declared.components[1].connectors = {
      {"k", ValueType::Float64, Causality::Input, {"degC", {}}, {"s.ssd", 6}}};
  declared.components[0].connectors.clear();
  declared.connections = {from_to("a.rise", "b.k")};
  CHECK(only_conversion(System(declared)).is_identity());  // a difference
  declared.connections = {from_to("a.bare", "b.k")};
  declared.components[0].description = thermal_with_output("bare");
  CHECK(only_conversion(System(declared)) == LinearConversion{1, 273.15});
}

TEST_CASE("Enumerations that differ in numbers or names are connected with a warning") {
  const auto unit = [](EnumerationItems items) {
    auto described =
        std::make_shared<UnitDescription>(*Describe("mode")
                                               .add("y", ValueType::Enumeration, Causality::Output)
                                               .add("u", ValueType::Enumeration, Causality::Input)
                                               .done());
    for (Variable& variable : described->variables) {
      if (variable.type == ValueType::Enumeration) variable.items = items;
    }
    return described;
  };
  SystemDeclaration declared;
  declared.components = {{"a", unit({{"off", 1}, {"on", 2}}), {}, {"s.ssd", 3}},
                         {"b", unit({{"off", 0}, {"on", 1}, {"idle", 2}}), {}, {"s.ssd", 4}}};
  declared.connections = {from_to("a.y", "b.u")};
  const System by_name(declared);
  CHECK(by_name.connections()[0].conversion.map == NumberMap{{1, 0}, {2, 1}});
  REQUIRE(by_name.warnings().size() == 1);
  CHECK_THAT(by_name.warnings()[0], StartsWith("s.ssd:9: the Enumerations of 'a.y' and 'b.u'") &&
                                        Contains("mapped by their names"));
  declared.components[1].description = unit({{"closed", 1}, {"open", 2}});
  const System by_number(declared);
  CHECK(by_number.connections()[0].conversion.is_identity());
  REQUIRE(by_number.warnings().size() == 1);
  CHECK_THAT(by_number.warnings()[0],
             Contains("'off' (1) becomes 'closed', 'on' (2) becomes 'open'"));
  declared.components[1].description = unit({{"on", 1}, {"up", 2}});
  CHECK_THAT(reason(declared), Contains("'on' is 2 and 1"));
  declared.connections.clear();
  declared.components[1].connectors = {
      {"u", ValueType::Enumeration, Causality::Input, {}, {"s.ssd", 5}, {{"on", 1}}}};
  CHECK(System(declared).warnings().empty());
  declared.components[1].connectors[0].items = {{"on", 2}};
  const System other(declared);
  REQUIRE(other.warnings().size() == 1);
  CHECK_THAT(other.warnings()[0],
             StartsWith("s.ssd:5: unit 'b', variable 'u': the connector's Enumeration has the item "
                        "'on' (2), and the unit's has not: on (1), up (2)"));
}
