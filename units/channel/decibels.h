// Ratios of powers in decibels.
#ifndef STRIDE_UNITS_CHANNEL_DECIBELS_H
#define STRIDE_UNITS_CHANNEL_DECIBELS_H

#include <algorithm>
#include <cmath>

namespace channel {

/// The ratio in decibels, but not below -200 dB nor above 200 dB, so that it can be recorded.
inline double decibels(double ratio) {
  return std::clamp(10.0 * std::log10(std::max(ratio, 0.0)), -200.0, 200.0);
}

/// The inverse.
inline double from_decibels(double decibels) { return std::pow(10.0, decibels / 10.0); }

}  // namespace channel

#endif
