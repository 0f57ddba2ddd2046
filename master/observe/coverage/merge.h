// Coverage of several runs becomes one.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_MERGE_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_MERGE_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "master/observe/coverage/report.h"

namespace stride::coverage {

/// Adds the counts of another one, point by point: of points with the same definition the bins are
/// added, all others stand beside each other. The order of merging changes nothing of the result:
/// it is commutative and associative.
///
/// Of a bin that both have hit the first visit is the one in the earlier case, or at the earlier
/// instant. Of the bins of a point that were not declared the first kMostOpenBins in bin_order()
/// are kept, and the visits of the others are in kFurther. A group has the greatest of the goals.
/// Throws std::invalid_argument for points that are not the same though their definitions are said
/// to be.
void merge(Report& report, const Report& other);

/// Adds what a case has hit. Groups and points that the definitions have not are passed over.
/// `report` began as an empty_report() of them, and has seen only cases of them. The order of cases
/// changes nothing, as that of merge().
void add_case(Report& report, std::span<const GroupDefinition> definitions,
              const CoveredBins& covered, std::uint64_t index);

/// The percentages of the groups after one run that has hit this.
std::vector<std::optional<double>> percentages(std::span<const GroupDefinition> definitions,
                                               const CoveredBins& covered);

}  // namespace stride::coverage

#endif
