#include "master/study/campaign/evaluation/case_columns.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/master/study/campaign/records.h"

using namespace stride::campaign;
using namespace stride::tests;

TEST_CASE("records become columns, whether they are there or not") {
  const Records records(
      deterministic(value_set("b.u", {"1", "2e0"}) + value_set("a.boolean", {"true", "false"})),
      "<stride:Aggregate name='most' signal='b.y' function='max'/>");
  records.write(0, {.aggregates = {0.5}, .reached = 1, .wall_time = 0.25});
  records.write(2, {.outcome = Outcome::Failed,
                    .reason = "low: no",
                    .verdicts = {{"low", "Never", false, "no", 0.75, CaseMargin{-0.5, "V", 0.75}},
                                 {"low", "", false, "no", 0.5},
                                 {"up", "Always", true, "", {}, CaseMargin{2, "", 1}},
                                 {"end", "Always", {}, "", {}}},
                    .aggregates = {std::nullopt},
                    .has_results = true,
                    .wall_time = 0.5});
  const CaseColumns columns = read_case_columns(records.plan, records.cases, 100);
  CHECK(columns.indices == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(columns.outcomes == std::vector<std::uint8_t>{0, kMissing, 1, kMissing});
  REQUIRE(columns.parameters.size() == 2);
  CHECK(columns.parameters[0].name == "b.u");
  CHECK(columns.parameters[0].is_number);
  CHECK(columns.parameters[0].numbers == std::vector<double>{1, 1, 2, 2});
  CHECK_FALSE(columns.parameters[1].is_number);
  CHECK(columns.parameters[1].texts == std::vector<std::string>{"true", "false", "true", "false"});
  CHECK(columns.aggregates.at(0).at(0) == 0.5);
  CHECK(std::isnan(columns.aggregates.at(0).at(2)));
  REQUIRE(columns.margins.size() == 2);
  CHECK((columns.margins[0].name == "low" && columns.margins[0].unit == "V"));
  CHECK((columns.margins[1].name == "up" && columns.margins[1].values.size() == 4));
  CHECK((columns.margins[0].values[2] == -0.5 && columns.margins[1].values[2] == 2));
  CHECK((std::isnan(columns.margins[0].values[0]) && std::isnan(columns.margins[0].values[3])));
  CHECK(columns.failed_at[2] == 0.5);
  CHECK(std::isnan(columns.failed_at[0]));
  CHECK(columns.has_results == std::vector<std::uint8_t>{0, 0, 1, 0});
  CHECK(columns.reasons[2] == "low: no");
  CHECK(columns.counts == std::array<std::uint64_t, kOutcomeKinds>{1, 1, 0, 0, 0, 2});
  CHECK(columns.wall_time == 0.75);
  REQUIRE(columns.checks.size() == 4);
  CHECK(columns.checks[1].kind == "");
  CHECK(columns.checks[1].failed == 1);
  CHECK(columns.checks[2].passed == 1);
  CHECK(columns.checks[3].undecided == 1);
}

TEST_CASE("a value of the scenario is no number, and seeds are no parameters") {
  const Records records(
      deterministic("<DeterministicMultiParameterDistribution><ValueSetDistribution>"
                    "<ParameterValueSet><ParameterAssignment parameterRef='b.u' value='3'/>"
                    "</ParameterValueSet><ParameterValueSet>"
                    "<ParameterAssignment parameterRef='c.time_constant' value='1'/>"
                    "</ParameterValueSet></ValueSetDistribution>"
                    "</DeterministicMultiParameterDistribution>"),
      "<stride:Seed variables='a.int32'/>");
  const CaseColumns columns = read_case_columns(records.plan, records.cases, 100);
  REQUIRE(columns.parameters.size() == 2);
  CHECK(columns.parameters[0].numbers[0] == 3);
  CHECK(std::isnan(columns.parameters[0].numbers[1]));
}

TEST_CASE("of too many cases there is one of each part, and all are counted") {
  const Records records("1000");
  records.write(17, {.aggregates = {1}});
  const CaseColumns columns = read_case_columns(records.plan, records.cases, 100);
  REQUIRE(columns.size() == 100);
  std::size_t of_first_half = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto index = static_cast<std::size_t>(columns.indices[i]);
    CHECK(index / 10 == i);
    of_first_half += index % 10 < 5 ? 1 : 0;
  }
  CHECK(of_first_half > 30);
  CHECK(of_first_half < 70);
  CHECK(columns.counts.at(kMissing) == 999);
  CHECK(columns.counts.at(0) == 1);
  CHECK(read_case_columns(records.plan, records.cases, 100).indices == columns.indices);
}
