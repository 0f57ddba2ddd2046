#include "master/study/campaign/evaluation/case_analysis.h"

#include <algorithm>
#include <limits>
#include <map>

namespace stride::campaign {
namespace {

constexpr auto kPassed = static_cast<std::uint8_t>(Outcome::Passed);

/// 0 or 1; NaN without a record.
std::vector<double> failures(const CaseColumns& columns) {
  std::vector<double> made;
  for (const std::uint8_t outcome : columns.outcomes) {
    made.push_back(outcome == kMissing ? std::numeric_limits<double>::quiet_NaN()
                                       : double(outcome != kPassed));
  }
  return made;
}

std::vector<ValueShare> shares_of(const CaseColumns& columns, const ParameterColumn& parameter) {
  std::map<std::string, ValueShare> values;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns.outcomes[i] == kMissing) continue;
    ValueShare& share = values[parameter.texts[i]];
    ++share.cases;
    share.failed += columns.outcomes[i] != kPassed ? 1 : 0;
  }
  std::vector<ValueShare> shares;
  for (auto& [value, share] : values) {
    share.value = value;
    share.confidence = share_confidence(share.failed, share.cases);
    shares.push_back(share);
  }
  std::ranges::stable_sort(shares, std::greater{}, &ValueShare::cases);
  return shares;
}

}  // namespace

CaseAnalysis analyse(const CaseColumns& columns) {
  CaseAnalysis analysis;
  const std::vector<double> failed = failures(columns);
  for (std::size_t i = 0; i < columns.parameters.size(); ++i) {
    const ParameterColumn& parameter = columns.parameters[i];
    if (!parameter.is_number) {
      std::vector<ValueShare> shares = shares_of(columns, parameter);
      const std::size_t count = shares.size();
      shares.resize(std::min(count, kMostShares));
      analysis.shares.push_back({i, count, std::move(shares)});
      continue;
    }
    ParameterCorrelation& made = analysis.correlations.emplace_back();
    made.parameter = i;
    made.with_failure = rank_correlation(parameter.numbers, failed);
    for (const auto& aggregate : columns.aggregates) {
      made.with_aggregates.push_back(rank_correlation(parameter.numbers, aggregate));
    }
    for (const MarginColumn& margin : columns.margins) {
      made.with_margins.push_back(rank_correlation(parameter.numbers, margin.values));
    }
  }
  return analysis;
}

}  // namespace stride::campaign
