#include "master/study/search/way.h"

#include <string>

#include <catch2/catch.hpp>

#include "tests/master/study/campaign/support.h"

using namespace stride::tests;
using namespace stride::campaign;
using namespace stride::search;

namespace {

const ValueKind kReal{.type = ValueKind::Type::Float64};

std::string text(const Way& way, double share) { return way.at(share).value_or("-"); }

}  // namespace

TEST_CASE("a way goes from the nominal value to that of the failing case") {
  const Way way(kReal, 1.0, "3", 0.01);
  CHECK(way.is_continuous());
  CHECK(text(way, 0) == "-");
  CHECK(text(way, 0.25) == "1.5");
  CHECK(text(way, 1) == "3");
  CHECK(text(Way(kReal, 1.0, "-3.0", 0.01), 0.75) == "-2");
}

TEST_CASE("there is nothing on a way to what is not finite") {
  for (const char* end : {"inf", "-inf", "nan"}) {
    const Way way(kReal, 1.0, end, 0.01);
    CHECK_FALSE(way.is_continuous());
    CHECK(text(way, 0.5) == end);
  }
}

TEST_CASE("numbers on a way have as many digits as the tolerance needs") {
  CHECK(text(Way(kReal, 0.0, "0.123456789", 0.01), 1.0 / 3) == "0.0412");
  CHECK(text(Way(kReal, 0.0, "123456789", 0.01), 1.0 / 3) == "41200000");
  CHECK(text(Way(kReal, 0.0, "0.123456789", 0.01), 1) == "0.123456789");
  for (const double tolerance : {0.2, 0.01, 0.0003}) {
    const Way way(kReal, 0.7, "19.3", tolerance);
    for (double share = 0.001; share < 1; share += 0.0173) {
      const double exact = 0.7 + share * 18.6;
      CHECK(std::stod(text(way, share)) == Approx(exact).margin(tolerance * 18.6 / 2));
    }
  }
}

TEST_CASE("whole numbers and instants are so on their way") {
  CHECK(text(Way({.type = ValueKind::Type::Whole}, 2.0, "9", 0.01), 0.5) == "6");
  CHECK(text(Way({.type = ValueKind::Type::Instant}, 0.0, "1e-9", 0.0001), 1.0 / 3) ==
        "0.000000000333");
}

TEST_CASE("where there is no number at one end there is nothing in between") {
  for (const Way& way :
       {Way(kReal, {}, "3", 0.01), Way(kReal, 3.0, "3", 0.01), Way(kReal, 3.0, {}, 0.01),
        Way({.type = ValueKind::Type::Text}, {}, "3", 0.01)}) {
    CHECK_FALSE(way.is_continuous());
    CHECK(way.at(0) == Text());
    CHECK(way.at(0.5) == way.at(1));
  }
}

TEST_CASE("the ways of a plan end at the scenario's start values, and declared interventions") {
  const CampaignFolder folder(campaign_text(
      deterministic(value_set("b.time_constant", {"3"}) + value_set("wire.from", {"0.75"}) +
                    value_set("wire.value", {"9"}) + value_set("wire.enabled", {"false"})),
      "<stride:Intervention name='wire'><stride:Force variable='b.u' value='0.5' from='0.25'/>"
      "</stride:Intervention>"));
  const CampaignScenario scenario(folder.read(), "1.0");
  const Plan plan(folder.read(), scenario.kinds(), scenario.fingerprints());
  const auto ways = ways_of(plan, scenario, plan.at(0).values, 0.01);
  REQUIRE(ways.size() == 4);
  CHECK(ways[0].nominal() == 1.0);
  CHECK(ways[1].nominal() == 0.25);
  CHECK(ways[2].nominal() == 0.5);
  CHECK_FALSE(ways[3].is_continuous());
}
