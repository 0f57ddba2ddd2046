#ifndef STRIDE_MASTER_COMPARE_COVERAGES_H
#define STRIDE_MASTER_COMPARE_COVERAGES_H

#include "master/compare/difference.h"
#include "master/coverage/report.h"

namespace stride::compare {

/// Points of which the bins were hit a different number of times, or that only one has.
Differences compare_coverages(const coverage::Report& a, const coverage::Report& b);

}  // namespace stride::compare

#endif
