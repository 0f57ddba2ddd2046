#include "master/study/campaign/shared_beginnings.h"

#include <numeric>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;

namespace {

const std::string kBrokenWire =
    "<stride:Intervention name='wire'><stride:Force variable='a.u' value='2' from='0.5'/>"
    "</stride:Intervention>";

std::vector<SharedBeginning> groups_of(const Plan& plan) {
  std::vector<std::uint64_t> cases(plan.size());
  std::iota(cases.begin(), cases.end(), 0);
  return shared_beginnings(plan, cases, {at(0), at(1)});
}

using Cases = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("cases that differ by an intervention share what is before the earliest one") {
  const Plan plan = plan_of(campaign_text(
      deterministic(value_set("wire.from", {"0.75", "0.5"}) + value_set("a.x", {"1", "2"}) +
                    value_set("wire.value", {"3", "4", "5"})),
      kBrokenWire));
  const auto groups = groups_of(plan);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].cases == Cases{0, 1, 2, 6, 7, 8});
  CHECK(groups[0].until == at(0.5));
  CHECK(groups[1].cases == Cases{3, 4, 5, 9, 10, 11});
}

TEST_CASE("cases that share nothing are alone") {
  const auto sizes = [](const std::string& text) {
    std::vector<std::size_t> sizes;
    for (const SharedBeginning& group : groups_of(plan_of(text))) {
      sizes.push_back(group.cases.size());
    }
    return sizes;
  };
  using Sizes = std::vector<std::size_t>;
  CHECK(sizes(campaign_text(deterministic(value_set("a.x", {"1", "1"})))) == Sizes{1, 1});
  CHECK(sizes(campaign_text(
            deterministic(value_set("a.x", {"1", "2"}) + value_set("wire.value", {"3", "4"})),
            kBrokenWire)) == Sizes{2, 2});
  CHECK(sizes(campaign_text(deterministic(value_set("wire.from", {"0", "0.5", "0.75"})),
                            kBrokenWire)) == Sizes{1, 2});
  CHECK(sizes(campaign_text(deterministic(value_set("wire.value", {"1", "2", "3", "4"})),
                            kBrokenWire + "<stride:Keep results='none' every='2'/>")) ==
        Sizes{2, 2});
}
