#include "master/system/ssp/version.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string version(const std::string& attributes, std::vector<std::string>& warnings) {
  const auto document = stride::xml::Document::parse("<s:Set xmlns:s='s'" + attributes + "/>", "x");
  return read_version(document.root(), warnings);
}

}  // namespace

TEST_CASE("the versions of SSP are read without a warning") {
  std::vector<std::string> warnings;
  CHECK(version(" version='1.0'", warnings) == "1.0");
  CHECK(version(" version=' 2.0 '", warnings) == "2.0");
  CHECK(warnings.empty());
}

TEST_CASE("another minor version is read as the one that is known, with a warning") {
  const auto [written, read_as] = GENERATE(table<std::string, std::string>({
      {"1.1", "1.0"},
      {"1.0.1", "1.0"},
      {"1.0-beta.2", "1.0"},
      {"1", "1.0"},
      {"2.1", "2.0"},
  }));
  std::vector<std::string> warnings;
  CHECK(version(" version='" + written + "'", warnings) == read_as);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "x:1: the version '" + written + "' of <s:Set> is not known; it is read as " + read_as);
}

TEST_CASE("another major version is refused, and none at all") {
  std::vector<std::string> warnings;
  for (const std::string wrong : {"3.0", "11.0", "0.1", "first", ".1"}) {
    CHECK_THROWS_WITH(version(" version='" + wrong + "'", warnings),
                      Contains("the version '" + wrong + "' of <s:Set> is not known"));
  }
  CHECK_THROWS_WITH(version("", warnings), Contains("<s:Set> needs the attribute 'version'"));
}

TEST_CASE("each file of a system has a version of its own") {
  const TemporaryFolder folder;
  folder.write("p.ssv",
               "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/"
               "SystemStructureParameterValues' version='1.2' name='p'><ssv:Parameters/>"
               "</ssv:ParameterSet>");
  const auto file = folder.write(
      "x.ssd", ssd("<ssd:System name='s'><ssd:Elements><ssd:Component name='a' source='a.fmu'>"
                   "<ssd:ParameterBindings><ssd:ParameterBinding source='p.ssv'>"
                   "<ssd:ParameterMapping><ssm:ParameterMapping version='1.3' "
                   "xmlns:ssm='http://ssp-standard.org/SSP1/SystemStructureParameterMapping'/>"
                   "</ssd:ParameterMapping></ssd:ParameterBinding></ssd:ParameterBindings>"
                   "</ssd:Component></ssd:Elements></ssd:System>",
                   "2.5"));
  const auto warnings = stride::scenario::read_scenario(file).warnings;
  REQUIRE(warnings.size() == 3);
  CHECK_THAT(warnings[0], Contains("x.ssd:2: the version '2.5'"));
  CHECK_THAT(warnings[1], Contains("p.ssv:1: the version '1.2'"));
  CHECK_THAT(warnings[2], Contains("x.ssd:3: the version '1.3'"));
}
