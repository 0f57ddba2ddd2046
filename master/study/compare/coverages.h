#ifndef STRIDE_MASTER_STUDY_COMPARE_COVERAGES_H
#define STRIDE_MASTER_STUDY_COMPARE_COVERAGES_H

#include "master/observe/coverage/report.h"
#include "master/study/compare/criteria/difference.h"

namespace stride::compare {

/// Points of which the bins were hit a different number of times, or that only one has.
Differences compare_coverages(const coverage::Report& a, const coverage::Report& b);

}  // namespace stride::compare

#endif
