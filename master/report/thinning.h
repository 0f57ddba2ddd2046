// Fewer rows, with all the extremes.
#ifndef STRIDE_MASTER_REPORT_THINNING_H
#define STRIDE_MASTER_REPORT_THINNING_H

#include <cstdint>
#include <optional>
#include <vector>

#include "master/report/column.h"

namespace stride::report {

/// How many rows to a block, if `rows` of so many columns are to become `limit` values at most;
/// nothing if they are no more.
std::optional<std::size_t> block_size(std::size_t rows, std::size_t columns, std::size_t limit);

/// Thins the rows from `first` on, one block of them: in each column the least and the greatest
/// value stay, and a NaN where there is one, each with its whole row; so do the block's first row
/// and its last.
void thin(std::vector<std::int64_t>& times, std::vector<Column>& columns, std::size_t first);

}  // namespace stride::report

#endif
