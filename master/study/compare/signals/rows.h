// Rows of signals.csv at the same instants.
#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_ROWS_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_ROWS_H

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/report/column.h"
#include "master/study/compare/criteria/tolerances.h"
#include "master/study/compare/signals/signal_tally.h"

namespace stride::compare {

/// Which rows belong together: of several at one instant the first with the first, and so on.
struct RowPairs {
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::vector<std::size_t> only_a;
  std::vector<std::size_t> only_b;
};

/// Times do not descend. Takes linear time.
RowPairs pair_rows(std::span<const Time> a, std::span<const Time> b);

/// `times`: of A.
void compare_rows(std::span<const Time> times, const report::Column& a, const report::Column& b,
                  std::span<const std::pair<std::size_t, std::size_t>> rows, Tolerance tolerance,
                  SignalTally& tally);

}  // namespace stride::compare

#endif
