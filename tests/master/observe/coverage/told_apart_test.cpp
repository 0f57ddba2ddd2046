#include "master/observe/coverage/told_apart.h"

#include <catch2/catch.hpp>

#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/merge.h"
#include "tests/master/base/archive/support.h"
#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

Report report_of(std::vector<PointDefinition> points) {
  return empty_report("s", std::vector{group_of(std::move(points))}, 1);
}

Items two_items(const char* first) { return Items({{0, first}, {1, "on"}}); }

/// Why the second one of two is told apart, without the definition.
std::string reason(const PointDefinition& a, const PointDefinition& b) {
  Report report = report_of({a});
  merge(report, report_of({b}));
  const auto found = told_apart(report);
  if (found.size() != 2) return std::to_string(found.size()) + " points";
  CHECK(found[0].why == "others define it otherwise");
  CHECK(found[0].point == "p@" + found[0].definition.substr(0, 8));
  const std::size_t end = found[1].why.find('@');
  CHECK(found[1].why.find(found[0].point) != std::string::npos);
  return found[1].why.substr(0, end);
}

}  // namespace

TEST_CASE("what is alike in all runs is not told apart") {
  const PointDefinition lamp = values_of("p", 1, truths());
  Report report = report_of({lamp});
  merge(report, report_of({lamp}));
  CHECK(told_apart(report).empty());
  CHECK(label(report.groups[0], report.groups[0].points[0]) == "p");
}

TEST_CASE("the first difference of two definitions is said") {
  const PointDefinition lamp = values_of("p", 1, truths());
  PointDefinition other = values_of("p", 1, two_items("off"));
  // which of them is the first one of the two is decided by their hashes
  CHECK_THAT(reason(lamp, other), Catch::Equals("bin 1 is 'off', and 'false' in p") ||
                                      Catch::Equals("bin 1 is 'false', and 'off' in p"));
  other = lamp;
  other.bins[1].is_ignored = true;
  CHECK_THAT(reason(lamp, other), Catch::Contains("'true', ignored"));
  other = lamp;
  other.bins.pop_back();
  CHECK_THAT(reason(lamp, other), Catch::Contains("bin 3 is") && Catch::Contains("not there"));
  other = lamp;
  other.unit = "mm";
  CHECK_THAT(reason(lamp, other), Catch::Contains("the unit of measure is"));
  other = lamp;
  other.signal = "q";
  CHECK_THAT(reason(lamp, other), Catch::Contains("the signal is") && Catch::Contains("'q'"));
  other = lamp;
  other.at_least = 2;
  CHECK_THAT(reason(lamp, other), Catch::Contains("at_least is"));
  other = lamp;
  other.kind = Kind::Transitions;
  CHECK_THAT(reason(lamp, other), Catch::Contains("the kind is"));
  const PointDefinition words = messages_of(Kind::Words, "p");
  other = words;
  other.ignored = {"x*"};
  CHECK(reason(words, other) == "other bins are ignored than in p");
}

TEST_CASE("what only some have is said, with its first case, also where it is read back") {
  const std::vector some{group_of({values_of("p", 1, truths())})};
  const std::vector more{group_of({values_of("p", 1, truths()), messages_of(Kind::Words, "w")})};
  Report report = empty_report("s", some, 0);
  add_case(report, some, {}, 0);
  add_case(report, some, {}, 3);
  Report other = empty_report("s", more, 0);
  add_case(other, more, {}, 2);
  merge(report, other);
  const auto check = [](const Report& all) {
    const auto found = told_apart(all);
    REQUIRE(found.size() == 1);
    CHECK((found[0].component == "device" && found[0].point == "w" && found[0].runs == 1));
    CHECK(found[0].first_case == 2U);
    CHECK(found[0].why == "the others have no such point");
  };
  check(report);
  const tests::Scratch scratch;
  write_coverage(scratch / "coverage.json", report);
  CHECK(read_coverage(scratch / "coverage.json") == report);
  check(read_coverage(scratch / "coverage.json"));
}

TEST_CASE("a cross whose part is another one is another one, and names its own") {
  const auto crossed = [](const char* first) {
    GroupDefinition group =
        group_of({values_of("a", 0, two_items(first)), values_of("b", 1, truths())});
    group.points.push_back(cross_of(group, {0, 1}));
    return empty_report("s", std::vector{group}, 1);
  };
  Report report = crossed("off");
  merge(report, crossed("dark"));
  const GroupReport& group = report.groups[0];
  REQUIRE(group.points.size() == 5);
  for (const std::size_t cross : {3U, 4U}) {
    const auto labels = part_labels(group, group.points[cross]);
    CHECK(labels[1] == "b");
    const std::size_t own = label(group, group.points[0]) == labels[0] ? 0 : 1;
    CHECK(labels[0] == label(group, group.points[own]));
    CHECK(group.points[cross].bins[0].name == group.points[own].bins[0].name + " × false");
  }
  CHECK(told_apart(report).back().why.find("a part of it is another one than in cross@") == 0);
}
