// Which parameters of a campaign decide what becomes of a case.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_ANALYSIS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_ANALYSIS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "master/study/campaign/evaluation/case_columns.h"
#include "master/study/campaign/evaluation/statistics.h"

namespace stride::campaign {

/// Of a parameter whose values are numbers.
struct ParameterCorrelation {
  std::size_t parameter = 0;                     ///< of CaseColumns::parameters
  RankCorrelation with_failure;                  ///< 1 for a case that has not passed, 0 else
  std::vector<RankCorrelation> with_aggregates;  ///< of CaseColumns::aggregates
  std::vector<RankCorrelation> with_margins;     ///< of CaseColumns::margins
};

/// Of the cases with a record in which a parameter has this value, which is no number.
struct ValueShare {
  std::string value;
  std::uint64_t cases = 0;
  std::uint64_t failed = 0;  ///< has not passed, in whatever way
  Confidence confidence;     ///< of the share of those
};
struct ParameterShares {
  std::size_t parameter = 0;
  std::size_t values = 0;          ///< how many there are
  std::vector<ValueShare> shares;  ///< of the most frequent ones, the most frequent first
};

struct CaseAnalysis {
  std::vector<ParameterCorrelation> correlations;
  std::vector<ParameterShares> shares;
};

inline constexpr std::size_t kMostShares = 50;

/// Cases without a record have no part in it.
CaseAnalysis analyse(const CaseColumns& columns);

}  // namespace stride::campaign

#endif
