#ifndef STRIDE_TANGENT_H
#define STRIDE_TANGENT_H

#include <cmath>
#include <stdexcept>

#include <stride/time.h>

namespace stride {

/// How long a quantity whose second derivative is at most `curvature` in magnitude stays within
/// `tolerance` of a line that begins at its value, with a slope that is wrong by `slope_error` at
/// most (in the quantity's unit, per s² and per s): by Taylor's theorem with Lagrange's remainder,
/// |y(t + h) - y(t) - slope h| <= slope_error h + curvature h²/2. With a slope that is right that
/// is sqrt(2 tolerance / curvature). Rounded down to a picosecond; Duration::max() where it is
/// longer than times can be. Throws std::invalid_argument for a negative number or NaN.
inline Duration tangent_holds_for(double tolerance, double curvature, double slope_error = 0) {
  if (!(tolerance >= 0) || !(curvature >= 0) || !(slope_error >= 0)) {
    throw std::invalid_argument("tolerance, curvature and the slope's error are at least 0");
  }
  if (curvature == 0 && slope_error == 0) return Duration::max();
  double seconds = std::sqrt(2 * (tolerance / curvature));
  if (slope_error > 0) {  // the positive root, in the form that does not subtract
    const double root = std::hypot(slope_error, std::sqrt(2 * curvature) * std::sqrt(tolerance));
    seconds = 2 * (tolerance / (slope_error + root));
  }
  if (!(seconds <= kMaxSeconds)) return Duration::max();
  return Duration(static_cast<Picoseconds>(std::floor(seconds * 1e12)));
}

}  // namespace stride

#endif
