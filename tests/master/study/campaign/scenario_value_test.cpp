#include <catch2/catch.hpp>

#include "master/study/campaign/campaign_scenario.h"
#include "tests/master/study/campaign/support.h"

using namespace stride::tests;
using stride::campaign::CampaignScenario;

namespace {

std::optional<double> value_of(const std::string& name, const std::string& values = "1") {
  const CampaignFolder folder(campaign_text(deterministic(value_set(name, {values.c_str()}))));
  return CampaignScenario(folder.read(), "1.0").scenario_value(0);
}

}  // namespace

TEST_CASE("a parameter has the unit's start value where neither case nor scenario gives one") {
  CHECK(value_of("b.u") == 0.0);
  CHECK(value_of("b.time_constant") == 1.0);
  CHECK(value_of("a.matrix[2,1]") == 4.0);
}

TEST_CASE("a parameter has the scenario's value where that gives one") {
  const CampaignFolder folder(campaign_text(deterministic(value_set("b.u", {"1"}))));
  std::string text = content(folder / "x.ssd");
  const std::string component = "minimal.fmu'/>";
  text.replace(
      text.find(component), component.size(),
      "minimal.fmu'><ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
      "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/SystemStructureParameterValues' "
      "version='2.0' name='p'><ssv:Parameters><ssv:Parameter name='u'><ssv:Float64 "
      "value='0.75'/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>"
      "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings></ssd:Component>");
  folder.write("x.ssd", text);
  CHECK(CampaignScenario(folder.read(), "1.0").scenario_value(0) == 0.75);
}

TEST_CASE("what is no number has no such value") {
  CHECK_FALSE(value_of("a.boolean", "true"));
  CHECK_FALSE(value_of("a.string", "x"));
}
