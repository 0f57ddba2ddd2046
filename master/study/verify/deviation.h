// How far the values of two runs are from each other.
#ifndef STRIDE_MASTER_STUDY_VERIFY_DEVIATION_H
#define STRIDE_MASTER_STUDY_VERIFY_DEVIATION_H

#include <string>
#include <vector>

#include "master/study/verify/row.h"

namespace stride::verify {

/// Differences up to this share of the largest value are rounding: sums that are made in another
/// order, a solver that begins anew.
constexpr double kRounding = 1e-9;

struct Deviation {
  bool is_equal = true;  ///< bit for bit
  /// The largest difference, as a share of the variable's largest value in the runs, or of 1e-6 if
  /// that is larger; 1 for what is no number, and where the runs have other instants.
  double worst = 0;
  std::string text;  ///< where it is worst; the first values are those that are expected
};

/// `names`: of the columns. Both runs are without events.
Deviation deviation(const std::vector<std::string>& names, const std::vector<Row>& expected,
                    const std::vector<Row>& seen);

}  // namespace stride::verify

#endif
