#include "units/nfc_channel/link.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nfc_channel {

double link_efficiency(double coupling, double first_quality, double second_quality) {
  const double u_squared = coupling * coupling * first_quality * second_quality;
  const double root = 1.0 + std::sqrt(1.0 + u_squared);
  return u_squared / (root * root);
}

double signal_to_noise(double signal_power, const Noise& noise, double bit_rate) {
  if (!(signal_power > 0.0)) return 0.0;
  const double noise_power = kBoltzmann * noise.temperature * bit_rate + noise.interference;
  return noise_power > 0.0 ? signal_power / noise_power : std::numeric_limits<double>::infinity();
}

double decibels(double ratio) {
  return std::clamp(10.0 * std::log10(std::max(ratio, 0.0)), -200.0, 200.0);
}

double bit_error_probability(double snr) { return 0.5 * std::exp(-0.5 * std::max(snr, 0.0)); }

}  // namespace nfc_channel
