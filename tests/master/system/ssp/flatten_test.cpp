#include "master/system/ssp/flatten.h"

#include <algorithm>

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

Scenario read(const std::string& text) {
  const TemporaryFolder folder;
  return read_scenario(folder.write("x.ssd", text));
}

std::string component(const std::string& name) {
  return "<ssd:Component name='" + name + "' source='" + name + ".fmu'/>\n";
}

std::string connector(const std::string& name, const std::string& kind,
                      const std::string& type = "") {
  return "<ssd:Connector name='" + name + "' kind='" + kind + "'>" + type + "</ssd:Connector>\n";
}

/// "a.x", "y": ends of a connection; without a dot, of the system itself.
std::string wire(const std::string& start, const std::string& end, const std::string& inside = "",
                 const std::string& attributes = "") {
  const auto of = [](const std::string& word, const std::string& name) {
    const std::size_t dot = name.find('.');
    const std::string element =
        dot == std::string::npos ? "" : word + "Element='" + name.substr(0, dot) + "' ";
    return element + word + "Connector='" +
           (dot == std::string::npos ? name : name.substr(dot + 1)) + "' ";
  };
  return "<ssd:Connection " + of("start", start) + of("end", end) + attributes + ">" + inside +
         "</ssd:Connection>\n";
}

std::string system(const std::string& name, const std::string& connectors,
                   const std::string& elements, const std::string& connections,
                   const std::string& attributes = "", const std::string& before = "") {
  return "<ssd:System name='" + name + "' " + attributes + "><ssd:Connectors>\n" + connectors +
         "</ssd:Connectors>" + before + "<ssd:Elements>\n" + elements +
         "</ssd:Elements><ssd:Connections>\n" + connections + "</ssd:Connections></ssd:System>\n";
}

std::string parameters(const std::string& name, const std::string& value) {
  return "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues><ssv:ParameterSet "
         "version='2.0' name='p'><ssv:Parameters><ssv:Parameter name='" +
         name + "'>" + value +
         "</ssv:Parameter></ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
         "</ssd:ParameterBinding></ssd:ParameterBindings>";
}

/// "a.y > s.y > b.u", the path of each connection, sorted.
std::vector<std::string> paths(const Scenario& scenario) {
  std::vector<std::string> paths;
  for (const core::ConnectionDeclaration& connection : scenario.system.connections) {
    std::string path = connection.from_component + "." + connection.from_connector;
    for (const auto& via : connection.via) path += " > " + via.connector.name;
    paths.push_back(path + " > " + connection.to_component + "." + connection.to_connector);
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// "a.u = 1", the text and the target of each value.
std::vector<std::string> values(const Scenario& scenario) {
  std::vector<std::string> values;
  for (const core::StartDeclaration& start : scenario.system.start_values) {
    values.push_back(start.component + "." + start.variable + " = " + start.value);
  }
  return values;
}

using Strings = std::vector<std::string>;

/// A system with an input u and an output y, with the elements in between.
std::string filter(const std::string& name, const std::string& element = component("core"),
                   const std::string& inner = "core") {
  return system(name, connector("u", "input") + connector("y", "output"), element,
                wire("u", inner + ".u") + wire(inner + ".y", "y"));
}

}  // namespace

TEST_CASE("systems in systems become components that are named by their paths") {
  const Scenario scenario = read(
      ssd(system("root", "", component("first") + filter("s", filter("t"), "t") + component("z"),
                 wire("first.y", "s.u") + wire("s.y", "z.u"))));
  Strings names;
  for (const auto& component : scenario.system.components) names.push_back(component.name);
  CHECK(names == Strings{"first", "s.t.core", "z"});
  CHECK(scenario.sources[1].filename() == "core.fmu");
  CHECK(paths(scenario) ==
        Strings{"first.y > s.u > s.t.u > s.t.core.u", "s.t.core.y > s.t.y > s.y > z.u"});
}

TEST_CASE(
    "the direction of a connection follows from the kinds on the way, however it is written") {
  const std::string s = system("s", connector("u", "input") + connector("y", "output"),
                               component("c"), wire("c.u", "u") + wire("y", "c.y"));
  const Scenario scenario = read(ssd(system("root", "", component("a") + s + component("b"),
                                            wire("s.u", "a.y") + wire("b.u", "s.y"))));
  CHECK(paths(scenario) == Strings{"a.y > s.u > s.c.u", "s.c.y > s.y > b.u"});
}

TEST_CASE("one connector of a system may lead to many, and straight through it") {
  const std::string s =
      system("s", connector("u", "input") + connector("y", "output"),
             component("c") + component("d"), wire("u", "c.u") + wire("u", "d.u") + wire("u", "y"));
  const Scenario scenario = read(ssd(system("root", "", component("a") + s + component("b"),
                                            wire("a.y", "s.u") + wire("s.y", "b.u"))));
  CHECK(paths(scenario) ==
        Strings{"a.y > s.u > s.c.u", "a.y > s.u > s.d.u", "a.y > s.u > s.y > b.u"});
}

TEST_CASE("what is done to a value on its way stays with the way") {
  const std::string s =
      system("s", connector("u", "input", "<ssc:Float64 unit='cm'/>"), component("c"),
             wire("u", "c.u", "<ssc:LinearTransformation factor='3'/>"));
  const Scenario scenario = read(ssd(
      system("root", "", component("a") + s,
             wire("a.y", "s.u", "<ssc:LinearTransformation offset='2'/>",
                  "suppressUnitConversion='true'")) +
      "<ssd:Units><ssc:Unit name='cm'><ssc:BaseUnit m='1' factor='0.01'/></ssc:Unit></ssd:Units>"));
  const core::ConnectionDeclaration& connection = scenario.system.connections.at(0);
  CHECK(connection.transformation.linear.factor == 3);
  CHECK_FALSE(connection.suppress_unit_conversion);
  REQUIRE(connection.via.size() == 1);
  CHECK(connection.via[0].segment.suppress_unit_conversion);
  CHECK(connection.via[0].segment.transformation.linear.offset == 2);
  CHECK(connection.via[0].connector.unit.name == "cm");
  CHECK(connection.via[0].connector.unit.meaning->factor == 0.01L);
  CHECK(connection.via[0].connector.type == core::ValueType::Float64);
  CHECK(connection.via[0].connector.takes_after_next);
}

TEST_CASE("components have the units of measure of their file") {
  const Scenario scenario = read(ssd(
      system("root", "", component("a"), "") +
      "<ssd:Units><ssc:Unit name='cm'><ssc:BaseUnit m='1' factor='0.01'/></ssc:Unit></ssd:Units>"));
  const auto& units = scenario.system.components.at(0).units_of_measure;
  REQUIRE(units);
  CHECK(units->at("cm").factor == 0.01L);
}

TEST_CASE("a connector does not set the interval of a clock, and a warning says so") {
  const std::string a =
      "<ssd:Component name='a' source='a.fmu'><ssd:Connectors>" +
      connector("tick", "input", "<ssc:Clock intervalVariability='fixed' intervalDecimal='0.5'/>") +
      "</ssd:Connectors></ssd:Component>\n";
  const auto warnings = read(ssd(system("root", "", a, ""))).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("intervalDecimal=\"0.5\" of <ssc:Clock> is ignored"));
}

TEST_CASE(
    "values are for what has their name, those of outer systems replace those of inner ones") {
  const std::string inner =
      system("s", "", component("c"), "", "", parameters("c.k", "<ssv:Real value='2'/>"));
  const Scenario scenario =
      read(ssd(system("root", "", inner, "", "", parameters("s.c.k", "<ssv:Real value='3'/>"))));
  CHECK(values(scenario) == Strings{"s.c.k = 2", "s.c.k = 3"});
}

TEST_CASE("a connection from a system's connector decides, whatever is given to the element") {
  const auto value = [](const std::string& text) { return "<ssv:Real value='" + text + "'/>"; };
  const std::string of_component =
      "<ssd:Component name='c' source='c.fmu'>" + parameters("k", value("1")) + "</ssd:Component>";
  const std::string inner = system("s", connector("p", "parameter"), of_component, wire("p", "c.k"),
                                   "", parameters("p", value("2")) + parameters("c.k", value("3")));
  const auto decided = [&](const std::string& of_root) {
    return values(read(ssd(system("root", connector("q", "parameter"), inner, wire("q", "s.p"), "",
                                  of_root))))
        .back();
  };
  const std::string direct = parameters("s.c.k", value("4"));
  const std::string nested = parameters("s.p", value("5"));
  const std::string outermost = parameters("q", value("6"));
  CHECK(decided("") == "s.c.k = 2");
  CHECK(decided(direct) == "s.c.k = 2");
  CHECK(decided(nested + direct) == "s.c.k = 5");
  CHECK(decided(outermost + nested + direct) == "s.c.k = 6");
}

TEST_CASE("the command line decides over the file, and a connector among its values") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "x.ssd", ssd(system("root", connector("q", "parameter"), component("c"), wire("q", "c.k"), "",
                          parameters("q", "<ssv:Real value='1'/>"))));
  const ParameterValue direct{"c.k", "2", {}, {"--set c.k=2", 0}, {}, true};
  const ParameterValue decisive{"q", "3", {}, {"--set q=3", 0}, {}, true};
  CHECK(values(read_scenario(file, {{}, {direct}})).back() == "c.k = 2");
  const Scenario scenario = read_scenario(file, {{}, {decisive, direct}});
  CHECK(values(scenario).back() == "c.k = 3");
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("--set c.k=2: the value is not used") &&
                                       Contains("connected to 'q', which has one by --set q=3"));
}

TEST_CASE("values of one set have one rank, unless a connection gives one of them precedence") {
  const auto set = [](const std::string& values) {
    return "<ssd:ParameterBinding><ssd:ParameterValues><ssv:ParameterSet version='2.0' name='p'>"
           "<ssv:Parameters>" +
           values +
           "</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
           "</ssd:ParameterBinding>";
  };
  const auto value = [](const std::string& name) {
    return "<ssv:Parameter name='" + name + "'><ssv:Real value='1'/></ssv:Parameter>";
  };
  const std::string bindings = "<ssd:ParameterBindings>" + set(value("c.a") + value("c.b")) +
                               set(value("c.d") + value("q") + value("c.e")) +
                               "</ssd:ParameterBindings>";
  const TemporaryFolder folder;
  const auto file =
      folder.write("x.ssd", ssd(system("root", connector("q", "parameter"), component("c"),
                                       wire("q", "c.k"), "", bindings)));
  const ParameterValue one{"c.f", "2", {}, {"--set c.f=2", 0}, {}, true};
  const ParameterValue other{"c.g", "3", {}, {"--set c.g=3", 0}, {}, true};
  const Scenario scenario = read_scenario(file, {{}, {one, other}});
  CHECK(values(scenario) ==
        Strings{"c.a = 1", "c.b = 1", "c.d = 1", "c.e = 1", "c.k = 1", "c.f = 2", "c.g = 3"});
  std::vector<std::size_t> ranks;
  for (const core::StartDeclaration& start : scenario.system.start_values) {
    ranks.push_back(start.rank);
  }
  CHECK(ranks == std::vector<std::size_t>{1, 1, 2, 2, 3, 4, 5});
}

TEST_CASE("a unit of measure of a connector that is no number is a warning") {
  const auto warnings = read(ssd(system("root", "",
                                        "<ssd:Component name='a' source='a.fmu'><ssd:Connectors>" +
                                            connector("n", "input", "<ssc:Integer unit='m'/>") +
                                            connector("x", "input", "<ssc:Real unit='m'/>") +
                                            "</ssd:Connectors></ssd:Component>",
                                        "")))
                            .warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("unit=\"m\" of <ssc:Integer> is ignored"));
}

TEST_CASE("connectors of systems can be recorded: those of the root, and on demand of others") {
  const Scenario scenario =
      read(ssd(system("root", connector("y", "output"), component("a") + filter("s"),
                      wire("a.y", "s.u") + wire("s.y", "y"))));
  Strings outputs;
  for (const core::OutputDeclaration& output : scenario.system.outputs) {
    outputs.push_back(output.via.back().connector.name + " = " + output.component + "." +
                      output.variable + (output.is_inner ? " inside" : ""));
  }
  CHECK(outputs == Strings{"y = s.core.y", "s.u = a.y inside", "s.y = s.core.y inside"});
}

TEST_CASE("an output that an input of the root leads to has the value that is given to it") {
  const Scenario scenario = read(
      ssd(system("root",
                 connector("i", "input", "<ssc:Real/>") + connector("o", "output", "<ssc:Real/>") +
                     connector("open", "input") + connector("p", "output"),
                 component("a"), wire("i", "o") + wire("open", "p"), "",
                 parameters("i", "<ssv:Real value='4'/>")),
          "1.0"));
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("the output 'p' is not recorded") &&
                                       Contains("'open' that it is connected to has no value"));
  REQUIRE(scenario.system.outputs.size() == 1);
  const core::OutputDeclaration& output = scenario.system.outputs[0];
  CHECK(output.component.empty());
  CHECK(output.value == "4");
  REQUIRE(output.via.size() == 2);
  CHECK(output.via[0].connector.name == "i");
  CHECK(output.via[1].connector.name == "o");
  CHECK(output.via[1].connector.type == core::ValueType::Float64);
}

TEST_CASE("a value for a connector of a system goes where the connector leads") {
  const auto with = [](const std::string& name, const std::string& inner_wire) {
    const std::string s =
        system("s", connector("u", "input") + connector("y", "output"),
               component("c") + component("d"), inner_wire + wire("u", "d.v") + wire("c.y", "y"));
    return read(ssd(system("root", connector("x", "parameter") + connector("open", "input"), s,
                           wire("x", "s.u"), "", parameters(name, "<ssv:Real value='7'/>"))));
  };
  CHECK(values(with("x", wire("u", "c.u"))) == Strings{"s.c.u = 7", "s.d.v = 7"});
  CHECK(values(with("s.u", wire("u", "c.u"))) == Strings{"s.c.u = 7", "s.d.v = 7"});
  CHECK(values(with("s.y", "")) == Strings{"s.c.y = 7"});
  const Scenario transformed =
      with("s.u", wire("u", "c.u", "<ssc:LinearTransformation factor='2'/>"));
  CHECK(transformed.system.start_values.at(0).transformation.linear.factor == 2);
  CHECK(transformed.system.start_values.at(0).via.size() == 1);
  const Scenario open = with("open", "");
  CHECK(open.system.start_values.empty());
  CHECK_THAT(open.warnings.at(0), Contains("'open', which leads to no component"));
}

TEST_CASE("the start value of an output behind a transformation cannot be set") {
  const std::string s = system("s", connector("y", "output"), component("c"),
                               wire("c.y", "y", "<ssc:LinearTransformation factor='2'/>"));
  CHECK_THROWS_WITH(
      read(ssd(system("root", "", s, "", "", parameters("s.y", "<ssv:Real value='7'/>")))),
      Contains("'s.y' is an output behind a transformation"));
}

TEST_CASE("a system in a file of its own is a component") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("sub/s.ssd", ssd(filter("any", component("core")), "1.0"));
  const std::string binding = parameters("core.k", "<ssv:Real value='5'/>");
  const Scenario scenario = read_scenario(
      folder.write("x.ssd", ssd(system("root", "",
                                       component("a") +
                                           "<ssd:Component name='s' source='sub/s.ssd' "
                                           "type='application/x-ssp-definition'>" +
                                           binding + "</ssd:Component>",
                                       wire("a.y", "s.u")))));
  CHECK(paths(scenario) == Strings{"a.y > s.u > s.core.u"});
  CHECK(scenario.sources.at(1) == folder / "sub/core.fmu");
  CHECK(values(scenario) == Strings{"s.core.k = 5"});
}

TEST_CASE("the settings of a system that is a component are not used, which is said once") {
  const TemporaryFolder folder;
  std::string inner = ssd(filter("any", component("core")), "1.0");
  const std::string end = "</ssd:SystemStructureDescription>";
  inner.insert(inner.find(end),
               "<ssd:Annotations><ssc:Annotation type='org.stride'/>"
               "<ssc:Annotation type='other'/></ssd:Annotations>");
  folder.write("s.ssd", inner);
  const std::string twice =
      "<ssd:Component name='s' source='s.ssd'/>"
      "<ssd:Component name='t' source='s.ssd'/>";
  const Scenario scenario =
      read_scenario(folder.write("x.ssd", ssd(system("root", "", twice, ""))));
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0],
             Contains("s.ssd:") && Contains("the annotation org.stride of a system inside "
                                            "another one is not used"));
}

TEST_CASE("a system of the same file can be used more than once") {
  const Scenario scenario = read(ssd(
      system("root", "",
             system("s", connector("u", "input"), component("c"), wire("u", "c.u"), "id='once'") +
                 "<ssd:Component name='again' source='#once' type='application/x-ssp-definition'/>",
             "")));
  REQUIRE(scenario.system.components.size() == 2);
  CHECK(scenario.system.components[1].name == "again.c");
  CHECK_THROWS_WITH(read(ssd(system("root", "", "<ssd:Component name='a' source='#two'/>", ""))),
                    Contains("no <ssd:System> of this file has the id 'two'"));
  CHECK_THROWS_WITH(
      read(ssd(system("root", "", "<ssd:Component name='a' source='#me'/>", "", "id='me'"))),
      Contains("x.ssd:5: more than 64 systems inside each other") && Contains("a part of itself"));
}

TEST_CASE("references to a signal dictionary share its signals, across systems") {
  const std::string dictionary =
      "<ssd:SignalDictionaries><ssd:SignalDictionary name='bus'><ssb:SignalDictionary "
      "version='2.0' "
      "xmlns:ssb='http://ssp-standard.org/SSP1/SystemStructureSignalDictionary'>"
      "<ssb:DictionaryEntry name='speed'><ssc:Float64 unit='m/s'/></ssb:DictionaryEntry>"
      "</ssb:SignalDictionary></ssd:SignalDictionary></ssd:SignalDictionaries>";
  const std::string reference = "<ssd:SignalDictionaryReference name='link' dictionary='bus'/>";
  const auto with = [&](const std::string& inner_wire) {
    const std::string s = system("s", "", component("c") + reference, inner_wire);
    std::string root =
        system("root", "", component("a") + reference + s, wire("a.y", "link.speed"));
    return ssd(root.insert(root.rfind("</ssd:System>"), dictionary));
  };
  const Scenario scenario = read(with(wire("link.speed", "c.u")));
  CHECK(paths(scenario) == Strings{"a.y > s.link.speed > s.c.u"});
  CHECK(scenario.system.connections[0].via[0].connector.unit.name == "m/s");
  std::string without_source = with(wire("link.speed", "c.u"));
  const std::string source = wire("a.y", "link.speed");
  without_source.replace(without_source.find(source), source.size(), wire("link.speed", "a.y"));
  const Scenario open = read(without_source);
  REQUIRE(open.warnings.size() == 1);
  CHECK_THAT(
      open.warnings[0],
      Contains("the signal 's.link.speed' has no source, so 's.c.u' gets no value from it") &&
          Contains("declare the connectors with their kinds"));
  CHECK_THROWS_WITH(read(with(wire("link.sped", "c.u"))),
                    Contains("has no entry 'sped'") && Contains("did you mean 'speed'?"));
  CHECK_THROWS_WITH(read(ssd(system("root", "", component("a") + reference, ""))),
                    Contains("there is no signal dictionary 'bus'"));
}

TEST_CASE("the error of a connection without an end has its place") {
  const std::string s = filter("s");
  const auto with = [&](const std::string& connections) {
    return ssd(system("root", connector("x", "input") + connector("y", "output"),
                      component("a") + s, connections));
  };
  const auto [text, message] = GENERATE_COPY(table<std::string, std::string>({
      {with(wire("a.y", "s.v")), "the system 's' has no connector 'v'"},
      {with(wire("z", "a.u")), "the system itself has no connector 'z'"},
      {with(wire("b.y", "s.u")), "there is no component 'b'"},
      {with(wire("x", "s.y")), "cannot connect 'x' to 's.y': a value comes from both"},
      {with(wire("s.u", "y")), "cannot connect 's.u' to 'y': a value goes to both"},
      {with(wire("a.y", "s.u") + wire("a.z", "s.u")),
       "'s.u' has two sources: 'a.z' here and 'a.y' in line"},
      {ssd(system("root", "", component("s.core") + s, "")), "two components are named 's.core'"},
      {ssd(system(
           "root", "",
           system("s", connector("u", "input") + connector("y", "output"), "", wire("u", "y")) +
               component("a"),
           wire("s.y", "s.u") + wire("a.y", "a.u"))),
       "(accepted)"},
  }));
  if (message == "(accepted)") {
    CHECK(paths(read(text)) == Strings{"a.y > a.u"});  // a circle without a component has no value
  } else {
    CHECK_THROWS_WITH(read(text), Contains("x.ssd:") && Contains(message));
  }
}

TEST_CASE("indices restrict a connection to an element, which gets its name from them") {
  const std::string inside = system("s", connector("y", "output"), component("c"),
                                    wire("c.m", "y", "", "startIndices='2 3' "));
  const Scenario scenario =
      read(ssd(system("root", "", component("a") + inside,
                      wire("s.y", "a.u", "", "endIndices='1'") + wire("a.v[4]", "a.w[5]"))));
  CHECK(paths(scenario) == Strings{"a.v[4] > a.w[5]", "s.c.m[2,3] > s.y > a.u[1]"});
  CHECK_THAT(
      error_of([&] {
        read(ssd(system("root", "", component("a"), wire("a.y", "a.u", "", "startIndices='1,2'"))));
      }),
      Contains("startIndices"));
}

TEST_CASE("the kind of an array's connector is that of its elements, too") {
  const std::string declared = "<ssd:Component name='a' source='a.fmu'><ssd:Connectors>" +
                               connector("u", "input") + connector("y", "output") +
                               "</ssd:Connectors></ssd:Component>\n";
  const Scenario scenario = read(ssd(system("root", "", declared, wire("a.u[1]", "a.y[2]"))));
  CHECK(paths(scenario) == Strings{"a.y[2] > a.u[1]"});
}

TEST_CASE("the dimensions of connectors are read, each with its size or the name of it") {
  const auto declared = [](const std::string& dimensions) {
    return "<ssd:Component name='a' source='a.fmu'><ssd:Connectors>" +
           connector("u", "input", "<ssc:Float64/>" + dimensions) +
           "</ssd:Connectors></ssd:Component>\n";
  };
  const Scenario scenario = read(ssd(system(
      "root", "", declared("<ssc:Dimension size='3'/><ssc:Dimension sizeConnector='n'/>"), "")));
  const auto& dimensions = scenario.system.components[0].connectors[0].dimensions;
  REQUIRE(dimensions.size() == 2);
  CHECK(dimensions[0].size == 3);
  CHECK(dimensions[1].size == std::nullopt);
  CHECK(dimensions[1].size_connector == "n");
  CHECK_THAT(error_of([&] { read(ssd(system("root", "", declared("<ssc:Dimension/>"), ""))); }),
             Contains("needs one of the attributes 'size' and 'sizeConnector'"));
}

TEST_CASE("a value for an element of a system's connector is for that element of its ends") {
  const auto with = [](const std::string& name, const std::string& inner_wire) {
    const std::string s = system("s", connector("u", "input") + connector("y", "output"),
                                 component("c"), inner_wire + wire("c.y", "y"));
    return values(
        read(ssd(system("root", "", s, "", "", parameters(name, "<ssv:Real value='7'/>")))));
  };
  CHECK(with("s.u", wire("u", "c.x[2]")) == Strings{"s.c.x[2] = 7"});
  CHECK(with("s.u[2]", wire("u", "c.x")) == Strings{"s.c.x[2] = 7"});
  CHECK(with("s.y[1,2]", "") == Strings{"s.c.y[1,2] = 7"});
  CHECK(with("s.v[2]", wire("u", "c.x")).empty());
}

TEST_CASE("what no component feeds is known by its ends, with what is declared of the way") {
  const std::string array = "<ssc:Float64/><ssc:Dimension size='3'/>";
  const std::string s = system("s", connector("u", "input", array), component("c"),
                               wire("u", "c.x") + wire("u", "c.z"));
  const Scenario scenario =
      read(ssd(system("root", connector("i", "input") + connector("j", "input"), s + component("a"),
                      wire("i", "s.u") + wire("j", "a.x[2]") + wire("a.y", "a.w"))));
  std::vector<std::string> ends;
  for (const core::InputDeclaration& input : scenario.system.inputs) {
    std::string text;
    for (const auto& via : input.via) text += via.connector.name + " > ";
    ends.push_back(text + input.component + "." + input.variable);
  }
  CHECK(ends == Strings{"i > s.u > s.c.x", "i > s.u > s.c.z", "j > a.x[2]"});
  const core::ViaDeclaration& inner = scenario.system.inputs.at(0).via.at(1);
  REQUIRE(inner.dimensions.size() == 1);
  CHECK(inner.dimensions[0].size == 3);
  CHECK(inner.where.line == 8);
}

TEST_CASE("indices in a file of SSP 1.0, which has none, are a warning, once for the file") {
  const std::string inside =
      system("root", "", component("a"),
             wire("a.y", "a.u", "", "startIndices='2'") + wire("a.y", "a.v", "", "endIndices='1'"));
  const Scenario scenario = read(ssd(inside, "1.0"));
  CHECK(paths(scenario) == Strings{"a.y > a.v[1]", "a.y[2] > a.u"});
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0],
             Contains("x.ssd:7: 'startIndices' is of SSP 2.0, and this file is of SSP 1.0"));
  CHECK(read(ssd(inside)).warnings.empty());
}
