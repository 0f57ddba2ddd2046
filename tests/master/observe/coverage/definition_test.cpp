#include "master/observe/coverage/definition.h"

#include <set>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "master/base/text/glob.h"
#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

TEST_CASE("the names of kinds read back") {
  for (const Kind kind : {Kind::Values, Kind::Transitions, Kind::Words, Kind::Lengths,
                          Kind::Sequences, Kind::Gaps, Kind::Cross}) {
    CHECK(kind_of(name(kind)) == kind);
  }
  CHECK_FALSE(kind_of("colours"));
}

TEST_CASE("a pattern means a name that it is, also one with brackets") {
  CHECK(core::means("[0, 1)", "[0, 1)"));
  CHECK(core::means("set_*", "set_led"));
  CHECK_FALSE(core::means("set_*", "reset_led"));
}

TEST_CASE("a cross has the bins that count in all of its parts, up to a limit") {
  const auto some = values_of("some", 0, equal_ranges(0, 2, 2, false, core::ValueType::Float64));
  const auto lamp = values_of("lamp", 1, truths());
  const std::vector<const PointDefinition*> parts{&some, &lamp};
  const auto bins = cross_bins(parts);
  REQUIRE(bins.size() == 4);
  CHECK(bins[1].name == "[0, 1) × true");
  const auto many = values_of("many", 0, equal_ranges(0, 1, 101, false, core::ValueType::Float64));
  const std::vector<const PointDefinition*> twice{&many, &many};
  CHECK_THROWS_AS(cross_bins(twice), std::invalid_argument);
}

TEST_CASE("each part of a definition is in its hash") {
  GroupDefinition group = group_of({values_of("lamp", 1, truths()), messages_of(Kind::Words, "w")});
  std::set<std::string> hashes{hash(std::vector{group})};
  const auto check_new = [&] { CHECK(hashes.insert(hash(std::vector{group})).second); };
  group.points[0].at_least = 2, check_new();
  group.points[0].bins[0].is_ignored = true, check_new();
  group.points[0].bins[0].name = "off", check_new();
  group.points[0].unit = "mm", check_new();
  group.points[1].ignored = {"x"}, check_new();
  group.points[1].is_open = false, check_new();
  group.goal = 1, check_new();
  group.name = "another", check_new();
  group.points.pop_back(), check_new();
  CHECK(hash(std::vector{group}) == hash(std::vector{group}));
}
