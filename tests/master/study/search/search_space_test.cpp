#include "master/study/search/search_space.h"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/study/campaign/support.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using stride::campaign::Plan;
using stride::campaign::Text;
using stride::search::SearchSpace;

namespace {

/// Values with a blank between them.
std::string texts(const SearchSpace& space, const stride::search::Point& point) {
  std::string joined;
  for (const Text& text : space.values(point)) joined += text.value_or("-") + " ";
  return joined;
}

}  // namespace

TEST_CASE("a coordinate of a distribution is a quantile") {
  const Plan plan = plan_of(campaign_text(
      stochastic(drawn("a.u", uniform("-1", "3")) +
                 drawn("b.u", "<NormalDistribution expectedValue='5' variance='4'/>"))));
  const SearchSpace space(plan.campaign(), plan.kinds());
  REQUIRE(space.dimensions() == 2);
  CHECK(texts(space, {0.25, 0.5}) == "0 5 ");
  for (const double edge : {0.0, 1.0}) {
    for (const Text& text : space.values({edge, edge})) CHECK(std::isfinite(std::stod(*text)));
  }
}

TEST_CASE("values of a set, and steps of a range, have equal parts of a coordinate") {
  const Plan plan = plan_of(campaign_text(
      deterministic(value_set("a.u", {"7", "8", "9", "x"}) + value_range("b.u", "0", "0.5", "1"))));
  const SearchSpace space(plan.campaign(), plan.kinds());
  REQUIRE(space.dimensions() == 2);
  CHECK(texts(space, {0, 0}) == "7 0 ");
  CHECK(texts(space, {0.24, 0.32}) == "7 0 ");
  CHECK(texts(space, {0.26, 0.34}) == "8 0.5 ");
  CHECK(texts(space, {1, 1}) == "x 1 ");
}

TEST_CASE("where nothing varies there is nothing to search") {
  const Plan plan = plan_of(campaign_text(stochastic("", "4"), "<stride:Seed variables='a.u'/>"));
  CHECK_THAT(error_of([&] { SearchSpace(plan.campaign(), plan.kinds()); }),
             Contains("c.xosc: nothing varies in this campaign"));
}
