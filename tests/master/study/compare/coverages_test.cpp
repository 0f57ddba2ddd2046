#include "master/study/compare/coverages.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;

namespace {

coverage::Report report_of(std::uint64_t low, std::uint64_t high,
                           const std::string& point = "input") {
  coverage::PointReport made{.name = point};
  made.bins = {{.name = "low", .count = low}, {.name = "high", .count = high}};
  coverage::GroupReport group{.component = "filter"};
  group.points.push_back(std::move(made));
  coverage::Report report;
  report.groups.push_back(std::move(group));
  return report;
}

}  // namespace

TEST_CASE("bins that were hit as often are equal") {
  CHECK(compare_coverages(report_of(1, 2), report_of(1, 2)).empty());
}

TEST_CASE("a point whose bins were hit otherwise is one difference") {
  const Differences differences = compare_coverages(report_of(1, 2), report_of(3, 0));
  REQUIRE(names_of(differences) == Names{"coverage filter.input"});
  CHECK(differences[0].a == "high: 2 hits");
  CHECK(differences[0].b == "high: 0 hits");
  CHECK(differences[0].count == 2);
}

TEST_CASE("a point that one has not is a difference") {
  const Differences differences = compare_coverages(report_of(1, 2), report_of(1, 2, "output"));
  REQUIRE(names_of(differences) == Names{"coverage filter.input", "coverage filter.output"});
  CHECK(differences[0].b == "none");
  CHECK(differences[1].a == "none");
}
