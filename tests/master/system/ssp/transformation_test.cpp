#include "master/system/ssp/transformation.h"

#include <catch2/catch.hpp>

#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;
using Kind = core::Transformation::Kind;

namespace {

core::ConnectionDeclaration with(const std::string& inside) {
  const TemporaryFolder folder;
  return read_scenario(
             folder.write("x.ssd",
                          ssd_with("<ssd:Component name='a' source='a.fmu'/>",
                                   "<ssd:Connections><ssd:Connection startElement='a' "
                                   "startConnector='x' endElement='a' endConnector='y'>\n" +
                                       inside + "</ssd:Connection></ssd:Connections>")))
      .system.connections.at(0);
}

std::string mapping(const std::string& kind, const std::string& entries) {
  return "<ssc:" + kind + "MappingTransformation>" + entries + "</ssc:" + kind +
         "MappingTransformation>";
}

std::string map_entry(const std::string& source, const std::string& target) {
  return "<ssc:MapEntry source='" + source + "' target='" + target + "'/>";
}

}  // namespace

TEST_CASE("True and FALSE of a mapping are taken, with a warning in the system's") {
  const auto mapped =
      with(mapping("Boolean", map_entry("True", "FALSE") + map_entry(" 0 ", "1"))).transformation;
  CHECK(mapped.numbers == NumberMap{{0, 1}, {1, 0}});
}

TEST_CASE("each transformation of SSP is read") {
  CHECK(with("").transformation.kind == Kind::None);
  const auto linear = with("<ssc:LinearTransformation factor='-2.5' offset='1e3'/>").transformation;
  CHECK(linear.kind == Kind::Linear);
  CHECK(linear.linear.factor == -2.5);
  CHECK(linear.linear.offset == 1000);
  CHECK(linear.where.line == 8);
  const auto identity = with("<ssc:LinearTransformation/>").transformation;
  CHECK(identity.linear.is_identity());
  const auto flag =
      with(mapping("Boolean", map_entry("true", "0") + map_entry("0", "true"))).transformation;
  CHECK(flag.kind == Kind::BooleanMapping);
  CHECK(flag.numbers == core::NumberMap{{0, 1}, {1, 0}});
  const auto number =
      with(mapping("Integer", map_entry("7", "-1") + map_entry("-3", "2"))).transformation;
  CHECK(number.kind == Kind::IntegerMapping);
  CHECK(number.numbers == core::NumberMap{{-3, 2}, {7, -1}});
  const auto item = with(mapping("Enumeration", map_entry("on", "go"))).transformation;
  CHECK(item.kind == Kind::EnumerationMapping);
  CHECK(item.names == std::vector<std::pair<std::string, std::string>>{{"on", "go"}});
}

TEST_CASE("transformations that cannot be meant are refused") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"<ssc:LinearTransformation factor='two'/>", "factor=\"two\""},
      {"<ssc:LinearTransformation factor='inf'/>", "is not a finite number"},
      {"<ssc:LinearTransformation faktor='2'/>", "did you mean 'factor'?"},
      {mapping("Integer", ""), "holds no <MapEntry>"},
      {mapping("Integer", map_entry("1.5", "2")), "source=\"1.5\""},
      {mapping("Integer", "<ssc:MapEntry source='1'/>"), "needs the attribute 'target'"},
      {mapping("Boolean", map_entry("maybe", "1")), "expected true or false"},
      {mapping("Boolean", map_entry("true", "1") + map_entry("1", "0")),
       "the source \"1\" is mapped twice"},
      {mapping("Enumeration", map_entry("a", "b") + map_entry("a", "c")), "\"a\" is mapped twice"},
      {mapping("Enumeration", "<ssc:Entry/>"), "known are: MapEntry"},
      {"<ssc:LinearTransformation/>" + mapping("Integer", map_entry("1", "2")),
       "is a second transformation; the first is in line 8"},
  }));
  CHECK_THROWS_WITH(with(text), Contains("x.ssd:8: ") && Contains(message));
}
