#include "master/system/ssp/parameters.h"

#include <catch2/catch.hpp>

#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;
using stride::core::StartDeclaration;

namespace {

std::string set(const std::string& parameters, const std::string& version = "2.0") {
  return "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/SystemStructureParameterValues'"
         " version='" +
         version + "' name='set'><ssv:Parameters>" + parameters +
         "</ssv:Parameters></ssv:ParameterSet>";
}

std::string parameter(const std::string& name, const std::string& value) {
  return "<ssv:Parameter name='" + name + "'>" + value + "</ssv:Parameter>";
}

std::string inline_binding(const std::string& parameters, const std::string& attributes = "") {
  return "<ssd:ParameterBinding " + attributes + "><ssd:ParameterValues>" + set(parameters) +
         "</ssd:ParameterValues></ssd:ParameterBinding>";
}

std::string bindings(const std::string& inside) {
  return "<ssd:ParameterBindings>" + inside + "</ssd:ParameterBindings>";
}

std::string component_with(const std::string& bindings_inside) {
  return ssd_with("<ssd:Component name='a' source='a.fmu'>" + bindings(bindings_inside) +
                  "</ssd:Component>");
}

/// A system of the components a, a.b and c with these bindings.
std::string system_with(const std::string& bindings_inside,
                        const std::string& binding_of_a = inline_binding("")) {
  return ssd("<ssd:System name='s'>" + bindings(bindings_inside) +
             "<ssd:Elements><ssd:Component name='a' source='a.fmu'>" + bindings(binding_of_a) +
             "</ssd:Component><ssd:Component name='a.b' source='b.fmu'/>"
             "<ssd:Component name='c' source='c.fmu'/></ssd:Elements></ssd:System>");
}

std::vector<StartDeclaration> read_values(const std::string& text) {
  const TemporaryFolder folder;
  return read_scenario(folder.write("x.ssd", text)).system.start_values;
}

/// Its connector 'lone' leads to no component.
std::string system_with_lone_connector() {
  std::string text = system_with(inline_binding(""));
  text.insert(text.find("<ssd:Elements>"),
              "<ssd:Connectors><ssd:Connector name='lone' kind='input'/></ssd:Connectors>");
  return text;
}

}  // namespace

TEST_CASE("Inline values of a component are read as text, with their unit and line") {
  const auto values = read_values(component_with(inline_binding(
      parameter("r", "<ssv:Real value='1.5' unit='mm'/>") +
      parameter("v", "\n<ssv:Float64 value='1 2 3'/>") + parameter("i", "<ssv:UInt8 value='7'/>") +
      parameter("b", "<ssv:Boolean value='true'/>") + parameter("e", "<ssv:String value=''/>") +
      parameter("m", "<ssv:Enumeration value='on' name='Mode'/>") +
      parameter("x", "<ssv:Binary value='0aff'/>") +
      parameter("w", "<ssv:String><ssv:Value value='p'/><ssv:Value value='q'/></ssv:String>"))));
  REQUIRE(values.size() == 8);
  CHECK(values[0].component == "a");
  CHECK(values[0].variable == "r");
  CHECK(values[0].value == "1.5");
  CHECK(values[0].unit.name == "mm");
  CHECK(values[0].where.line == 5);
  CHECK(values[1].value == "1 2 3");
  CHECK(values[1].unit.name.empty());
  CHECK(values[1].where.line == 6);
  CHECK(values[2].value == "7");
  CHECK(values[2].is_integer);
  CHECK(!values[5].is_integer);
  CHECK(values[3].value == "true");
  CHECK(values[4].value.empty());
  CHECK(values[5].value == "on");
  CHECK(values[6].value == "0aff");
  CHECK(values[7].value == "p q");
}

TEST_CASE("A binding's prefix is put before each of its names") {
  const auto values = read_values(
      component_with(inline_binding(parameter("x", "<ssv:Real value='1'/>"), "prefix='adc.'")));
  REQUIRE(values.size() == 1);
  CHECK(values[0].variable == "adc.x");
}

TEST_CASE("Names at the system are those of a component and its variable") {
  const auto values = read_values(
      system_with(inline_binding(parameter("c.adc.x", "<ssv:Real value='1'/>") +
                                 parameter("a.b.y", "<ssv:Real value='2'/>")) +
                      inline_binding(parameter("z", "<ssv:Real value='3'/>"), "prefix='c.'"),
                  inline_binding(parameter("z", "<ssv:Real value='0'/>"))));
  REQUIRE(values.size() == 5);
  CHECK(values[0].component == "a");  // what is bound to the system comes later, so it replaces
  CHECK(values[0].variable == "z");
  CHECK(values[1].component == "c");
  CHECK(values[1].variable == "adc.x");
  CHECK(values[2].component == "a");  // a name may mean several variables: those that are there
  CHECK(values[2].variable == "b.y");
  CHECK(values[3].component == "a.b");
  CHECK(values[3].variable == "y");
  CHECK(values[2].group != 0);
  CHECK(values[2].group == values[3].group);
  CHECK(values[4].component == "c");
  CHECK(values[4].variable == "z");
  CHECK(values[4].group == 0);
}

TEST_CASE("A value that belongs to no component is skipped with a warning, as SSP requires") {
  const TemporaryFolder folder;
  const Scenario scenario = read_scenario(folder.write(
      "x.ssd", system_with(inline_binding(parameter("channle.x", "<ssv:Real value='1'/>")))));
  CHECK(scenario.system.start_values.empty());
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0],
             Contains("x.ssd:3: the parameter 'channle.x' belongs to no component") &&
                 Contains("known are: a"));
}

TEST_CASE("A value of the command line is for somebody") {
  const TemporaryFolder folder;
  const auto file = folder.write("x.ssd", system_with(inline_binding("")));
  ParameterValue value{"c.x", "1", {}, {"--set c.x=1", 0}, {}, true};
  const auto values = read_scenario(file, {{}, {value}}).system.start_values;
  REQUIRE(values.size() == 1);
  CHECK(values[0].component == "c");
  CHECK_FALSE(values[0].is_optional);
  value.name = "d.x";
  CHECK_THROWS_WITH(read_scenario(file, {{}, {value}}),
                    Contains("--set c.x=1: there is no component 'd'"));
}

TEST_CASE("A value of the command line for a component is not answered with connectors") {
  const TemporaryFolder folder;
  const auto file = folder.write("x.ssd", system_with_lone_connector());
  const auto error = [&](const std::string& name) {
    const ParameterValue value{name, "1", {}, {"--set", 0}, {}, true};
    return error_of([&] { read_scenario(file, {{}, {value}}); });
  };
  CHECK_THAT(error("pump.gain"), Contains("known are: a") && !Contains("lone"));
  CHECK_THAT(error("gain"), Contains("known are: lone, a") &&
                                Contains("names of parameters read component.variable"));
  CHECK_THAT(error("lon"), Contains("did you mean 'lone'?"));
}

TEST_CASE("A value of the command line for a connector that leads nowhere is an error") {
  const TemporaryFolder folder;
  const auto file = folder.write("x.ssd", system_with_lone_connector());
  const ParameterValue value{"lone", "1", {}, {"--set lone=1", 0}, {}, true};
  CHECK_THROWS_WITH(read_scenario(file, {{}, {value}}),
                    Contains("--set lone=1: the parameter 'lone' is for the connector 'lone', "
                             "which leads to no component"));
}

namespace {

std::string mapping(const std::string& entries) {
  return "<ssm:ParameterMapping version='2.0' "
         "xmlns:ssm='http://ssp-standard.org/SSP1/SystemStructureParameterMapping'>" +
         entries + "</ssm:ParameterMapping>";
}

std::string entry(const std::string& source, const std::string& target,
                  const std::string& inside = "", const std::string& attributes = "") {
  return "<ssm:MappingEntry source='" + source + "' target='" + target + "' " + attributes + ">" +
         inside + "</ssm:MappingEntry>";
}

std::string mapped_binding(const std::string& parameters, const std::string& map) {
  return "<ssd:ParameterBinding prefix='p.'><ssd:ParameterValues>" + set(parameters) +
         "</ssd:ParameterValues>" + map + "</ssd:ParameterBinding>";
}

}  // namespace

TEST_CASE("A mapping renames, transforms and repeats; what it does not name is not applied") {
  const std::string parameters = parameter("x", "<ssv:Real value='1' unit='m'/>") +
                                 parameter("y", "<ssv:Integer value='2'/>") +
                                 parameter("z", "<ssv:Real value='3'/>");
  const std::string map =
      mapping(entry("p.x", "u", "<ssc:LinearTransformation factor='2' offset='1'/>",
                    "suppressUnitConversion='true'") +
              entry("p.y", "n",
                    "<ssc:IntegerMappingTransformation><ssc:MapEntry source='2' target='5'/>"
                    "</ssc:IntegerMappingTransformation>") +
              entry("p.x", "v"));
  const TemporaryFolder folder;
  const bool is_inline = GENERATE(true, false);
  if (!is_inline) {
    folder.write(
        "map.ssm", "<?xml version='1.0'?>" + [&] {
          std::string text = map;  // a file declares its prefixes itself
          text.insert(text.find(" version"),
                      " xmlns:ssc='http://ssp-standard.org/SSP1/SystemStructureCommon'");
          return text;
        }());
  }
  const std::string element = is_inline ? "<ssd:ParameterMapping>" + map + "</ssd:ParameterMapping>"
                                        : "<ssd:ParameterMapping source='map.ssm'/>";
  const auto values =
      read_scenario(folder.write("x.ssd", component_with(mapped_binding(parameters, element))))
          .system.start_values;
  REQUIRE(values.size() == 3);
  CHECK(values[0].variable == "u");
  CHECK(values[0].value == "1");
  CHECK(values[0].unit.name == "m");
  CHECK(values[0].suppress_unit_conversion);
  CHECK(values[0].transformation.kind == stride::core::Transformation::Kind::Linear);
  CHECK(values[0].transformation.linear.factor == 2);
  CHECK(values[0].transformation.linear.offset == 1);
  CHECK(values[1].variable == "n");
  CHECK(values[1].transformation.numbers == stride::core::NumberMap{{2, 5}});
  CHECK(values[2].variable == "v");
  CHECK(values[2].transformation.kind == stride::core::Transformation::Kind::None);
}

TEST_CASE("A mapping without a meaning is refused, one without an effect is a warning") {
  const std::string parameters = parameter("x", "<ssv:Real value='1'/>");
  const auto with = [&](const std::string& inside) {
    return component_with(mapped_binding(
        parameters, "\n<ssd:ParameterMapping>" + inside + "</ssd:ParameterMapping>"));
  };
  CHECK_THROWS_WITH(read_values(with(mapping(entry("p.x", "u") + entry("p.x", "u")))),
                    Contains("x.ssd:6: two parameters are mapped to 'u'"));
  CHECK_THROWS_WITH(read_values(with("")), Contains("neither a source nor <ssm:ParameterMapping>"));
  CHECK_THROWS_WITH(read_values(with(set(""))), Contains("is not known in <ssd:ParameterMapping>"));
  const TemporaryFolder folder;
  const auto warnings =
      read_scenario(folder.write("x.ssd", with(mapping(entry("x", "u"))))).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("x.ssd:6: the parameter set has no 'x' to be mapped to 'u'"));
}

TEST_CASE("Many entries of a mapping without an effect are counted") {
  std::string entries;
  for (int i = 0; i < 100; ++i) entries += entry("x" + std::to_string(i), "u" + std::to_string(i));
  const TemporaryFolder folder;
  const std::string file = component_with(
      mapped_binding(parameter("y", "<ssv:Real value='1'/>"),
                     "<ssd:ParameterMapping>" + mapping(entries) + "</ssd:ParameterMapping>"));
  const auto warnings = read_scenario(folder.write("x.ssd", file)).warnings;
  REQUIRE(warnings.size() == 21);
  CHECK(warnings.back() == "… and 80 more entries whose parameter the set does not have");
}

TEST_CASE("a file that is a mapping renames the values of a set") {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  const auto values =
      read_parameter_set(folder.write("x.ssv", set(parameter("p", "<ssv:Real value='2'/>") +
                                                   parameter("q", "<ssv:Real value='3'/>"))),
                         warnings);
  const auto file = folder.write("x.ssm", mapping(entry("p", "a.k") + entry("r", "a.u")));
  const auto mapped = map_parameters(file, values, warnings);
  REQUIRE(mapped.size() == 1);
  CHECK(mapped[0].name == "a.k");
  CHECK(mapped[0].value == "2");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("x.ssm:1: the parameter set has no 'r'"));
  CHECK_THROWS_WITH(map_parameters(folder / "x.ssv", values, warnings),
                    Contains("is not a parameter mapping"));
}

TEST_CASE("The units of a set are those that it defines, or the scenario's if it is inside") {
  const auto unit = [](const std::string& name_space, const std::string& factor) {
    return "<" + name_space + ":Units><ssc:Unit name='in'><ssc:BaseUnit m='1' factor='" + factor +
           "'/></ssc:Unit></" + name_space + ":Units>";
  };
  const auto of = [&](const std::string& units_of_set) {
    std::string inside = set(parameter("x", "<ssv:Real value='1' unit='in'/>"));
    inside.insert(inside.find("</ssv:ParameterSet>"), units_of_set);
    return read_values(
               ssd("<ssd:System name='s'><ssd:Elements><ssd:Component name='a' source='a.fmu'>" +
                   bindings("<ssd:ParameterBinding><ssd:ParameterValues>" + inside +
                            "</ssd:ParameterValues></ssd:ParameterBinding>") +
                   "</ssd:Component></ssd:Elements></ssd:System>" + unit("ssd", "0.0254")))
        .at(0)
        .unit.meaning->factor;
  };
  CHECK(of("") == 0.0254L);
  CHECK(of(unit("ssv", "2")) == 2);
}

TEST_CASE("A component can hold its own parameters") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a.fmu/resources");
  folder.write("a.fmu/resources/own.ssv", set(parameter("x", "<ssv:Real value='4'/>")));
  const auto file = folder.write(
      "x.ssd",
      component_with("<ssd:ParameterBinding source='resources/own.ssv' sourceBase='component'/>"));
  CHECK(read_scenario(file).system.start_values.at(0).value == "4");
  const auto elsewhere = [&](const std::filesystem::path& path, const auto&) {
    CHECK(path == folder / "a.fmu");
    return folder / "b.fmu";
  };
  CHECK_THROWS_WITH(read_scenario(file, {elsewhere, {}}),
                    Contains("x.ssd:5: ") && Contains("b.fmu"));
  CHECK_THROWS_WITH(
      read_values(system_with("<ssd:ParameterBinding source='own.ssv' sourceBase='component'/>")),
      Contains("x.ssd:3: only a component can hold its own parameters"));
}

TEST_CASE("A component that is a system in another file can hold its own parameters, too") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sub/resources");
  folder.write("sub/resources/own.ssv", set(parameter("c.x", "<ssv:Real value='4'/>")));
  folder.write("sub/s.ssd", ssd_with("<ssd:Component name='c' source='c.fmu'/>"));
  const auto file =
      folder.write("x.ssd", ssd_with("<ssd:Component name='s' source='sub/s.ssd'>" +
                                     bindings("<ssd:ParameterBinding source='resources/own.ssv' "
                                              "sourceBase='component'/>") +
                                     "</ssd:Component>"));
  const StartDeclaration value = read_scenario(file).system.start_values.at(0);
  CHECK(value.component == "s.c");
  CHECK(value.value == "4");
}

TEST_CASE("A source that is empty is absent") {
  const auto values = read_values(
      component_with(inline_binding(parameter("x", "<ssv:Real value='1'/>"), "source=' '") +
                     "<ssd:ParameterBinding source=''><ssd:ParameterValues>" +
                     set(parameter("y", "<ssv:Real value='2'/>")) +
                     "</ssd:ParameterValues><ssd:ParameterMapping source=''>" +
                     mapping(entry("y", "z")) + "</ssd:ParameterMapping></ssd:ParameterBinding>"));
  REQUIRE(values.size() == 2);
  CHECK(values[0].variable == "x");
  CHECK(values[1].variable == "z");
  CHECK_THROWS_WITH(read_values(component_with("<ssd:ParameterBinding source=''/>")),
                    Contains("x.ssd:5: ") && Contains("has neither a source nor"));
  CHECK_THROWS_WITH(read_values(ssd_with("<ssd:Component name='a' source=''/>")),
                    Contains("the component 'a' has no source"));
}

TEST_CASE("Two parameters of one name in a set are an error, or a warning if they are the same") {
  const auto twice = [](const std::string& second) {
    return component_with(
        inline_binding(parameter("x", "<ssv:Real value='1' unit='m'/>") + "\n" + second));
  };
  for (const char* other : {"<ssv:Real value='2' unit='m'/>", "<ssv:Real value='1' unit='mm'/>"}) {
    CHECK_THROWS_WITH(
        read_values(twice(parameter("x", other))),
        Contains("x.ssd:6: two parameters are named 'x'; the first is in line 5, and they differ"));
  }
  const TemporaryFolder folder;
  const Scenario scenario =
      read_scenario(folder.write("x.ssd", twice(parameter("x", "<ssv:Real value='1' unit='m'/>"))));
  CHECK(scenario.system.start_values.size() == 1);
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("x.ssd:6: two parameters are named 'x'"));
}

TEST_CASE("The dimensions of a parameter are read") {
  const auto values = read_values(component_with(inline_binding(
      parameter("x",
                "<ssv:Float64><ssv:Value value='1'/><ssv:Value value='2'/></ssv:Float64>"
                "<ssc:Dimension size='2'/><ssc:Dimension sizeConnector='n'/>"))));
  REQUIRE(values.at(0).dimensions.size() == 2);
  CHECK(values[0].dimensions[0].size == 2);
  CHECK(values[0].dimensions[1].size_connector == "n");
}

TEST_CASE("A set in a file of its own is read relative to the scenario") {
  const TemporaryFolder folder;
  folder.write("my set.ssv", set(parameter("x", "\n<ssv:Real value='1'/>"), "1.0"));
  const auto values =
      read_scenario(folder.write("x.ssd", component_with("<ssd:ParameterBinding "
                                                         "source='my%20set.ssv' prefix='p.'/>")))
          .system.start_values;
  REQUIRE(values.size() == 1);
  CHECK(values[0].variable == "p.x");
  CHECK(values[0].where.file == (folder / "my set.ssv").string());
  CHECK(values[0].where.line == 2);
}

TEST_CASE("A broken set in a file of its own is named") {
  const TemporaryFolder folder;
  const auto text = component_with("<ssd:ParameterBinding source='p.ssv'/>");
  const auto file = folder.write("x.ssd", text);
  CHECK_THROWS_WITH(read_scenario(file),
                    Contains("x.ssd:5: the parameter set '") && Contains("p.ssv' does not exist"));
  folder.write("p.ssv", "<ssv:ParameterSet>");
  CHECK_THROWS_WITH(read_scenario(file), Contains("p.ssv:1: this is not well-formed XML"));
  folder.write("p.ssv", text);
  CHECK_THROWS_WITH(read_scenario(file),
                    Contains("p.ssv:2:") && Contains("is not a parameter set"));
  folder.write("p.ssv", set("", "9"));
  CHECK_THROWS_WITH(read_scenario(file),
                    Contains("p.ssv:1: the version '9' of <ssv:ParameterSet> is not known"));
}

TEST_CASE("Parameters that cannot be meant are refused") {
  const auto one = [](const std::string& value) {
    return component_with(inline_binding(parameter("x", value)));
  };
  const auto [text, message] = GENERATE_COPY(table<std::string, std::string>({
      {one(""), "<ssv:Parameter> holds no value"},
      {one("<ssv:Real/>"), "<ssv:Real> needs the attribute 'value'"},
      {one("<ssv:Rael value='1'/>"), "<ssv:Rael> is not a type of a parameter"},
      {one("<ssv:Real value='1'/><ssv:Real value='2'/>"), "<ssv:Parameter> has two values"},
      {one("<ssv:String value='1'><ssv:Value value='2'/></ssv:String>"), "has both"},
      {one("<ssv:String><ssv:Value value='a b'/><ssv:Value value='c'/></ssv:String>"),
       "does not support an array with an element that is empty or has blanks"},
      {one("<ssv:Real valeu='1'/>"), "has no attribute 'valeu'"},
      {component_with(inline_binding("<ssv:Parameter name='x' type='Real' value='1'/>")),
       "its value is an element in it: <ssv:Real value="},
      {component_with("<ssd:ParameterBinding/>"), "has neither a source nor <ParameterValues>"},
      {component_with("<ssd:ParameterBinding type='text/csv' source='a.csv'/>"),
       "does not support parameters of the type 'text/csv'"},
      {component_with("<ssd:ParameterBinding source='a.ssv' sourceBase='file'/>"),
       "the sourceBase 'file' is not known"},
      {component_with(inline_binding("").replace(inline_binding("").find("</ssd:ParameterBinding>"),
                                                 0, "<ssd:ParameterMapping source='a.ssm'/>")),
       "the parameter mapping '"},
      {component_with(
           "<ssd:ParameterBinding source='a.ssv'><ssd:ParameterValues/></ssd:ParameterBinding>"),
       "cannot have values of its own, too"},
      {component_with("<ssd:ParameterBinding><ssd:ParameterValues/></ssd:ParameterBinding>"),
       "holds no <ParameterSet>"},
      {component_with("<ssd:ParameterBinding><ssd:ParameterMaping/></ssd:ParameterBinding>"),
       "did you mean 'ParameterMapping'?"},
  }));
  CHECK_THROWS_WITH(read_values(text), Contains("x.ssd:5: ") && Contains(message));
}

TEST_CASE("Two lists of bindings are one, with a warning") {
  const TemporaryFolder folder;
  const auto scenario = read_scenario(folder.write(
      "x.ssd", ssd_with("<ssd:Component name='a' source='a.fmu'>" +
                        bindings(inline_binding(parameter("x", "<ssv:Real value='1'/>"))) + "\n" +
                        bindings(inline_binding(parameter("y", "<ssv:Real value='2'/>"))) +
                        "</ssd:Component>")));
  REQUIRE(scenario.system.start_values.size() == 2);
  CHECK(scenario.system.start_values[1].value == "2");
  REQUIRE(scenario.warnings.size() == 1);
  CHECK_THAT(scenario.warnings[0], Contains("a second <ssd:ParameterBindings>"));
}

TEST_CASE("a file that is a parameter set is read with the places of its values") {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  const auto values = read_parameter_set(
      folder.write("x.ssv", set("\n" + parameter("a.x", "<ssv:Float64 value='2' unit='m'/>") +
                                "\n" + parameter("a.y", "<ssv:Boolean value='true'/>"))),
      warnings);
  REQUIRE(values.size() == 2);
  CHECK(values[0].name == "a.x");
  CHECK(values[0].value == "2");
  CHECK(values[0].unit.name == "m");
  CHECK(values[1].where.line == 3);
  CHECK_FALSE(values[1].is_required);
  CHECK(warnings.empty());
  CHECK_THAT(error_of([&] { read_parameter_set(folder.write("y.ssv", "<x/>"), warnings); }),
             Contains("y.ssv:1: <x> is not a parameter set"));
}
