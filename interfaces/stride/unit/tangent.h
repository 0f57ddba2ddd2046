#ifndef STRIDE_UNIT_TANGENT_H
#define STRIDE_UNIT_TANGENT_H

#include <cmath>
#include <stdexcept>

#include <stride/time.h>

namespace stride {

/// How long a quantity whose second derivative is at most `curvature` in magnitude stays within
/// `tolerance` of its tangent (both in the quantity's unit, the former per s²): by Taylor's theorem
/// with Lagrange's remainder, |y(t + h) - y(t) - y'(t) h| <= curvature h²/2, so
/// h = sqrt(2 tolerance / curvature), rounded down to a picosecond; Duration::max() where that is
/// longer than times can be. Throws std::invalid_argument for a negative number or NaN.
inline Duration tangent_holds_for(double tolerance, double curvature) {
  if (!(tolerance >= 0) || !(curvature >= 0)) {
    throw std::invalid_argument("a tolerance and a curvature are at least 0");
  }
  if (curvature == 0) return Duration::max();
  const double seconds = std::sqrt(2 * (tolerance / curvature));
  if (!(seconds <= kMaxSeconds)) return Duration::max();
  return Duration(static_cast<std::int64_t>(std::floor(seconds * 1e12)));
}

}  // namespace stride

#endif
