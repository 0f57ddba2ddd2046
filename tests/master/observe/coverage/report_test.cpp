#include "master/observe/coverage/report.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

GroupDefinition example() {
  GroupDefinition group =
      group_of({values_of("level", 0, equal_ranges(0, 4, 4, false, core::ValueType::Float64)),
                messages_of(Kind::Words, "words", {{"read"}, {"write"}}),
                messages_of(Kind::Words, "all"), messages_of(Kind::Sequences, "sequences")});
  group.points.push_back(cross_of(group, {2, 0}));
  group.goal = 80;
  group.points[2].ignored = {"e*"};
  return group;
}

}  // namespace

TEST_CASE("a group's percentage is the mean of those of its closed points") {
  Report report = empty_report("s", std::vector{example()}, 1);
  GroupReport& group = report.groups[0];
  CHECK(group.percentage() == 0);
  CHECK(group.misses_goal());
  for (BinCount& bin : group.points[0].bins) bin.count = 1;
  CHECK(group.points[0].percentage() == 100);
  CHECK(group.percentage() == 50);
  group.points[1].bins[0].count = 1;
  CHECK(group.percentage() == 75);
  group.points[1].at_least = 2;
  CHECK(group.points[1].percentage() == 0);
}

TEST_CASE("bins that appear are ordered by numbers, and then as texts") {
  CHECK(bin_order("9", "10"));
  CHECK(bin_order("2-3", "16-31"));
  CHECK(bin_order("10", "a"));
  // from which numbers could be read that are none
  for (const char* const word : {"nanometre", "infinite"}) {
    CHECK((bin_order("10", word) && !bin_order(word, "10")));
    CHECK((bin_order("a", word) && bin_order(word, "z")));
  }
  CHECK(bin_order("a", "b"));
  CHECK_FALSE(bin_order("a", "a"));
}
