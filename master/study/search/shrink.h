// From a failing case towards the nominal one: what of it is needed for the failure.
#ifndef STRIDE_MASTER_STUDY_SEARCH_SHRINK_H
#define STRIDE_MASTER_STUDY_SEARCH_SHRINK_H

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace stride::search {

/// How far each parameter is from its nominal value, 0, to that of the failing case, 1.
using Shares = std::vector<double>;

struct Shrunk {
  Shares failing;  ///< a case that fails as the first one does
  /// Of each parameter that is not nominal, and has values in between: where the case passes with
  /// all others as in `failing`, within the tolerance of its share there.
  std::vector<std::optional<double>> passing;
};

/// Sets parameters back to their nominal values, one by one, until none of the rest can be without
/// the failure ending; then it bisects the way of each of these that has values in between. Behind
/// each boundary it looks at one place only, so where the failure comes and goes on the way, it is
/// one of its boundaries. `fails`: whether the failure is there; of the case of all shares 1 it is
/// taken for known. `is_continuous`: for each parameter. 0 < tolerance < 1.
Shrunk shrink(const std::vector<bool>& is_continuous, double tolerance,
              const std::function<bool(const Shares&)>& fails);

}  // namespace stride::search

#endif
