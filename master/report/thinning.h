// Fewer rows, with all the extremes.
#ifndef STRIDE_MASTER_REPORT_THINNING_H
#define STRIDE_MASTER_REPORT_THINNING_H

#include <cstddef>
#include <optional>
#include <vector>

#include <stride/time.h>

#include "master/report/column.h"

namespace stride::report {

/// How many rows to a block, if `rows` of so many columns are to become `limit` values at most;
/// nothing if they are no more.
std::optional<std::size_t> block_size(std::size_t rows, std::size_t columns, std::size_t limit);

/// Thins the rows from `first` on, one block of them: in each column the least and the greatest
/// value stay, and a NaN where there is one, each with its whole row; so do the block's first row
/// and its last.
void thin(std::vector<Time>& times, std::vector<Column>& columns, std::size_t first);

/// Thins rows, block by block, while they are added at the end. A block that has grown too long to
/// be held is thinned before it ends, too, which does not change what stays of it.
class Thinner {
 public:
  /// Nothing is thinned.
  Thinner() = default;
  /// `rows`: how many there will be at most.
  Thinner(std::size_t rows, std::size_t columns, std::size_t limit);

  /// How many rows to a block.
  std::optional<std::size_t> block() const { return block_; }
  /// Before a row is added whose time is not that of the last one.
  void make_room(std::vector<Time>& times, std::vector<Column>& columns);
  /// After the last row.
  void finish(std::vector<Time>& times, std::vector<Column>& columns);

 private:
  std::optional<std::size_t> block_;
  std::size_t most_held_ = 0;  ///< rows of the present block
  std::size_t first_ = 0;      ///< where the present block begins
  std::size_t count_ = 0;      ///< how many rows it has had
};

}  // namespace stride::report

#endif
