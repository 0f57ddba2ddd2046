// The values that stand for all that a plan has: if they fit, all do.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CANDIDATE_VALUES_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CANDIDATE_VALUES_H

#include <cstddef>
#include <string>
#include <vector>

#include "master/study/campaign/plan.h"

namespace stride::campaign {

struct CandidateValue {
  std::size_t column = 0;
  std::string text;
  core::Location where{};  ///< where it is written, or its distribution
  bool is_drawn = false;
};

/// Each text that is written, once for a column; of a range of numbers the first two and the last,
/// or all where they are no numbers to their variable; of drawn numbers the least and the greatest,
/// for which each case is looked at.
std::vector<CandidateValue> candidate_values(const Plan& plan);

}  // namespace stride::campaign

#endif
