#include "master/study/campaign/evaluation/case_analysis.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace stride::campaign;

namespace {

/// Cases with these outcomes, a number that grows, and a text.
CaseColumns columns_with(std::vector<std::uint8_t> outcomes, std::vector<std::string> texts) {
  CaseColumns columns;
  ParameterColumn number{.name = "n", .is_number = true, .numbers = {}, .texts = {}};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    columns.indices.push_back(static_cast<std::int32_t>(i));
    number.numbers.push_back(static_cast<double>(i));
  }
  columns.outcomes = std::move(outcomes);
  columns.parameters = {
      number, {.name = "t", .is_number = false, .numbers = {}, .texts = std::move(texts)}};
  return columns;
}

}  // namespace

TEST_CASE("whatever has not passed is a failure, and what is missing is neither") {
  CaseColumns columns = columns_with({0, 0, 1, 2, 3, 4, kMissing}, {"", "", "", "", "", "", ""});
  columns.aggregates = {{6, 5, 4, 3, 2, 1, 0}};
  const double kUndecided = std::numeric_limits<double>::quiet_NaN();
  const double kWorst = -std::numeric_limits<double>::infinity();
  columns.margins = {{"it holds", "m", {4, 3, kUndecided, 1, 0, -1, kWorst}}};
  const CaseAnalysis analysis = analyse(columns);
  REQUIRE(analysis.correlations.size() == 1);
  const ParameterCorrelation& found = analysis.correlations.front();
  CHECK(found.parameter == 0);
  CHECK(found.with_failure.count == 6);
  const std::vector<double> x{1, 2, 3, 4, 5, 6}, y{0, 0, 1, 1, 1, 1};
  CHECK(found.with_failure.value == rank_correlation(x, y).value);
  REQUIRE(found.with_aggregates.size() == 1);
  CHECK(found.with_aggregates.front().value == -1);
  CHECK(found.with_aggregates.front().count == 7);
  REQUIRE(found.with_margins.size() == 1);
  CHECK(found.with_margins.front().value == -1);
  CHECK(found.with_margins.front().count == 6);
}

TEST_CASE("the shares of failures of each text, the most frequent first") {
  const CaseColumns columns =
      columns_with({0, 1, 1, kMissing, 0, 2}, {"b", "a", "a", "a", "a", "c"});
  const CaseAnalysis analysis = analyse(columns);
  REQUIRE(analysis.shares.size() == 1);
  const ParameterShares& found = analysis.shares.front();
  CHECK(found.parameter == 1);
  CHECK(found.values == 3);
  REQUIRE(found.shares.size() == 3);
  CHECK(found.shares[0].value == "a");
  CHECK(found.shares[0].cases == 3);
  CHECK(found.shares[0].failed == 2);
  CHECK(found.shares[0].confidence.low == share_confidence(2, 3).low);
  CHECK(found.shares[1].value == "b");
  CHECK(found.shares[2].failed == 1);
}

TEST_CASE("of very many texts the most frequent ones are listed") {
  std::vector<std::string> texts{"often", "often"};
  for (int i = 0; i < 100; ++i) texts.push_back(std::to_string(i));
  const CaseColumns columns = columns_with(std::vector<std::uint8_t>(texts.size()), texts);
  const CaseAnalysis analysis = analyse(columns);
  CHECK(analysis.shares.front().values == 101);
  REQUIRE(analysis.shares.front().shares.size() == kMostShares);
  CHECK(analysis.shares.front().shares.front().value == "often");
}
