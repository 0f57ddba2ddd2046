// Signals of runs that have stepped differently.
#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_CURVES_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_CURVES_H

#include <span>

#include <stride/time.h>

#include "master/report/column.h"
#include "master/study/compare/criteria/tolerances.h"
#include "master/study/compare/signals/signal_tally.h"

namespace stride::compare {

/// A signal over time: between two rows it goes straight from one value to the next, or holds the
/// first one. Of several rows at one instant it has all values.
struct Curve {
  std::span<const Time> times;  ///< not descending, as many as the column has rows
  const report::Column& column;
};

struct CurveTolerances {
  Duration time{};
  Tolerance value{};
  bool is_held = false;  ///< rather than straight
  bool only_rows_of_b = false;
};

/// Each row of A with the curve of B, and each of B with that of A: at an instant t the other curve
/// has to have a value between t - time and t + time that the tolerance allows. Rows that are
/// farther than that from all rows of the other curve's span are left out. Takes n log n time.
void compare_curves(const Curve& a, const Curve& b, const CurveTolerances& tolerances,
                    SignalTally& tally);

}  // namespace stride::compare

#endif
