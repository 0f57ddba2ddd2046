#include "master/coverage/report.h"

#include <random>

#include <catch2/catch.hpp>

#include "master/coverage/demand.h"
#include "tests/master/coverage/support.h"

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

/// One run, and adds what it does to `all`, which has seen the runs before.
Report run(unsigned seed) {
  constexpr const char* kWords[] = {"read", "write", "erase", "10", "9"};
  std::mt19937 random(seed);
  Device device(example());
  for (int i = 0; i < 6; ++i) {
    device.message(i, kWords[random() % std::size(kWords)]);
    device.point(i, static_cast<double>(random() % 6));
  }
  return device.coverage.report("s");
}

std::string refusal(Report report, const Report& other) {
  try {
    merge(report, other);
  } catch (const std::invalid_argument& mistake) {
    return mistake.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a group's percentage is the mean of those of its closed points") {
  Report report = empty_report("s", std::vector{example()});
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

TEST_CASE("cases that are added are what merged reports are, in any order") {
  const std::vector definitions{example()};
  Report by_cases = empty_report("s", definitions);
  Report merged = run(0);
  Report backwards = run(19);
  for (unsigned seed = 0; seed < 20; ++seed) {
    add_case(by_cases, definitions, covered_bins(run(seed)), seed);
    if (seed > 0) merge(merged, run(seed));
    if (seed < 19) merge(backwards, run(18 - seed));
  }
  CHECK(backwards == merged);
  const PointReport& sequences = merged.groups[0].points[3];
  CHECK(sequences.bins.size() > 10);
  for (GroupReport& group : by_cases.groups) {
    for (PointReport& point : group.points) {
      for (std::size_t i = 0; i < point.bins.size(); ++i) {
        const PointReport& same = merged.groups[0].points[&point - group.points.data()];
        CHECK(point.bins[i].name == same.bins[i].name);
        CHECK(point.bins[i].count == same.bins[i].count);
        CHECK(point.bins[i].is_ignored == same.bins[i].is_ignored);
      }
    }
  }
}

TEST_CASE("the first case that hit a bin is the one that is named") {
  const std::vector definitions{example()};
  Report report = empty_report("s", definitions);
  add_case(report, definitions, {{"device", {{"all", {{"read", 2, 0.5}}}}}}, 3);
  add_case(report, definitions, {{"device", {{"all", {{"read", 1, 0.25}}}}}}, 5);
  add_case(report, definitions, {{"gone", {{"all", {{"read", 1, 0.25}}}}}}, 6);
  const BinCount& bin = report.groups[0].points[2].bins.at(0);
  CHECK(bin == BinCount{"read", false, 3, 0.5, 3});
}

TEST_CASE("reports of other definitions are refused with the first difference") {
  const Report report = empty_report("s", std::vector{example()});
  GroupDefinition other = example();
  other.points[0] = values_of("level", 0, equal_ranges(0, 5, 4, false, core::ValueType::Float64));
  CHECK(refusal(report, empty_report("s", std::vector{other})) ==
        "'device', point 'level': bin 1 is '[0, 1)' in one and '[0, 1.25)' in the other");
  other = example();
  other.points.pop_back();
  CHECK(refusal(report, empty_report("s", std::vector{other})) ==
        "there are 5 'device': points in one and 4 in the other");
  other = example();
  other.goal.reset();
  CHECK(refusal(report, empty_report("s", std::vector{other})) ==
        "'device': the goal is '80' in one and 'none' in the other");
  other = example();
  other.points[2].ignored.clear();
  CHECK(refusal(report, empty_report("s", std::vector{other})) ==
        "their definitions ignore different bins");
  CHECK(refusal(report, empty_report("t", std::vector{example()})).empty());
}

TEST_CASE("bins that appear are ordered by numbers, and then as texts") {
  CHECK(bin_order("9", "10"));
  CHECK(bin_order("2-3", "16-31"));
  CHECK(bin_order("10", "a"));
  CHECK(bin_order("a", "b"));
  CHECK_FALSE(bin_order("a", "a"));
}
