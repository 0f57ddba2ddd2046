#include "master/system/ssp/definitions.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "master/system/ssp/ssp.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

Definitions read_inside(const std::string& inside, std::vector<std::string>& warnings) {
  const auto document = stride::xml::Document::parse(ssd(inside), "x.ssd");
  return read_definitions(document.root(), kSsd, warnings);
}
Definitions read_inside(const std::string& inside) {
  std::vector<std::string> warnings;
  Definitions definitions = read_inside(inside, warnings);
  CHECK(warnings.empty());
  return definitions;
}

}  // namespace

TEST_CASE("units and enumerations are known by their names") {
  const Definitions definitions = read_inside(
      "<ssd:Enumerations><ssc:Enumeration name='Mode'><ssc:Item name='off' value='-1'/>"
      "<ssc:Item name='on' value='9223372036854775807'/></ssc:Enumeration></ssd:Enumerations>"
      "<ssd:Units><ssc:Unit name='degC'><ssc:BaseUnit K='1' offset='273.15'/></ssc:Unit>"
      "<ssc:Unit name='1/min'><ssc:BaseUnit s='-1' factor='0.1'/></ssc:Unit></ssd:Units>");
  const auto celsius = definitions.unit("degC").meaning.value();
  CHECK(celsius.exponents == std::array<int, 8>{0, 0, 0, 0, 1, 0, 0, 0});
  CHECK(celsius.factor == 1);
  CHECK(celsius.offset == 273.15L);
  CHECK(definitions.unit("1/min").meaning->exponents[2] == -1);
  CHECK(definitions.unit("1/min").meaning->factor == 0.1L);
  CHECK(definitions.unit("rpm").name == "rpm");
  CHECK_FALSE(definitions.unit("rpm").meaning);
  CHECK(definitions.enumerations.at("Mode") ==
        stride::core::EnumerationItems{{"off", -1}, {"on", 9223372036854775807}});
}

TEST_CASE("units in another namespace are read, and what is no unit is ignored, with a warning") {
  std::vector<std::string> warnings;
  const Definitions definitions = read_inside(
      "<ssd:Units><ssd:Unit name='a'><ssd:BaseUnit m='1'/></ssd:Unit>\n<ssc:Uint name='b'/>"
      "</ssd:Units>",
      warnings);
  CHECK(definitions.unit("a").meaning->exponents[1] == 1);
  REQUIRE(warnings.size() == 3);
  CHECK_THAT(warnings[0], Contains("x.ssd:") && Contains("<ssd:Unit> is taken for <ssc:Unit>"));
  CHECK_THAT(warnings[1], Contains("<ssd:BaseUnit> is taken for <ssc:BaseUnit>"));
  CHECK_THAT(warnings[2], Contains("<ssc:Uint> is not known in <ssd:Units> and is ignored"));
}

TEST_CASE("what a file does not define another may") {
  const Definitions inside =
      read_inside("<ssd:Units><ssc:Unit name='a'><ssc:BaseUnit m='1'/></ssc:Unit></ssd:Units>");
  const Definitions around = read_inside(
      "<ssd:Units><ssc:Unit name='a'><ssc:BaseUnit s='1'/></ssc:Unit>"
      "<ssc:Unit name='b'><ssc:BaseUnit s='1'/></ssc:Unit></ssd:Units>");
  CHECK(inside.unit("a", around).meaning->exponents[1] == 1);
  CHECK(inside.unit("b", around).meaning->exponents[2] == 1);
}

TEST_CASE(
    "a name that is defined twice is an error, or a warning if the definitions are the same") {
  const auto units = [](const std::string& second) {
    return "<ssd:Units><ssc:Unit name='L'><ssc:BaseUnit m='1' factor='10'/></ssc:Unit>\n"
           "<ssc:Unit name='L'><ssc:BaseUnit m='1' factor='" +
           second + "'/></ssc:Unit></ssd:Units>";
  };
  const auto enumerations = [](const std::string& second) {
    return "<ssd:Enumerations><ssc:Enumeration name='E'><ssc:Item name='a' value='1'/>"
           "</ssc:Enumeration>\n<ssc:Enumeration name='E'>" +
           second + "</ssc:Enumeration></ssd:Enumerations>";
  };
  const std::string a1 = "<ssc:Item name='a' value='1'/>", a2 = "<ssc:Item name='a' value='2'/>";
  CHECK_THROWS_WITH(read_inside(units("100")),
                    Contains("x.ssd:4: two units of measure are named 'L'; the first is in line 3, "
                             "and they differ"));
  CHECK_THROWS_WITH(read_inside(enumerations(a2)), Contains("x.ssd:4: two enumerations are named"));
  CHECK_THROWS_WITH(read_inside(enumerations(a1 + a2)), Contains("x.ssd:4: two items are named"));
  for (const std::string& same : {units("10"), enumerations(a1)}) {
    std::vector<std::string> warnings;
    read_inside(same, warnings);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("x.ssd:4: two ") && Contains("they are the same"));
  }
}

TEST_CASE("malformed definitions are refused") {
  const auto unit = [](const std::string& base) {
    return "<ssd:Units><ssc:Unit name='a'>\n<ssc:BaseUnit " + base + "/></ssc:Unit></ssd:Units>";
  };
  CHECK_THROWS_WITH(read_inside(unit("m='1.5'")), Contains("x.ssd:4: ") && Contains("m=\"1.5\""));
  CHECK_THROWS_WITH(read_inside(unit("factor='0'")), Contains("a unit cannot be zero"));
  CHECK_THROWS_WITH(
      read_inside(unit("m='1' factr='0.5'")),
      Contains("x.ssd:4: ") && Contains("has no attribute 'factr'") && Contains("factor"));
  CHECK_THROWS_WITH(read_inside("<ssd:Units><ssc:Unit name='a' offset='1'/></ssd:Units>"),
                    Contains("has no attribute 'offset'"));
  CHECK_THROWS_WITH(read_inside("<ssd:Enumerations><ssc:Enumeration name='M'>"
                                "<ssc:Item name='i' value='1' number='2'/>"
                                "</ssc:Enumeration></ssd:Enumerations>"),
                    Contains("has no attribute 'number'"));
  CHECK_THROWS_WITH(read_inside("<ssd:Enumerations><ssc:Enumeration name='M'><ssc:Item name='i'/>"
                                "</ssc:Enumeration></ssd:Enumerations>"),
                    Contains("needs the attribute 'value'"));
}
