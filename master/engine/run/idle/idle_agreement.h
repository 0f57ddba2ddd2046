// When a value with idle skipping counts as the one without it.
#ifndef STRIDE_MASTER_ENGINE_RUN_IDLE_IDLE_AGREEMENT_H
#define STRIDE_MASTER_ENGINE_RUN_IDLE_IDLE_AGREEMENT_H

#include <cmath>

namespace stride::core {

/// What sums over other steps may differ by, as a share of the greatest value.
inline constexpr double kIdleRounding = 1e-9;

/// Whether two values are no further apart than a tolerance and rounding; `greatest`: what counts
/// as the greatest value of the variable. False if one of the values is not finite.
inline bool agree_when_idle(double one, double other, double tolerance, double greatest) {
  return std::abs(one - other) <= tolerance + kIdleRounding * greatest;
}

}  // namespace stride::core

#endif
