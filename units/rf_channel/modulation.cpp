#include "units/rf_channel/modulation.h"

#include <algorithm>
#include <cmath>

namespace rf_channel {
namespace {

constexpr stride::Duration kMicrosecond{1'000'000};
constexpr PacketFormat kOqpskPacket{192 * kMicrosecond, 16, 16 * kMicrosecond, 4, 127, 2e6};
constexpr PacketFormat kGfskPacket{56 * kMicrosecond, 48, kMicrosecond, 1, 255, 1e6};

double oqpsk_error(double ratio) {
  double choices = 16.0;  // 16 over k
  double sum = 0.0;
  for (int k = 2; k <= 16; ++k) {
    choices *= (17.0 - k) / k;
    const double term = choices * std::exp(20.0 * ratio * (1.0 / k - 1.0));
    sum += k % 2 == 0 ? term : -term;
  }
  return std::clamp(8.0 / 15.0 / 16.0 * sum, 0.0, 0.5);
}

}  // namespace

const PacketFormat& packet_format(Modulation modulation) {
  return modulation == Modulation::Gfsk ? kGfskPacket : kOqpskPacket;
}

double correlated_fsk_error(double bit_energy_to_noise, double correlation) {
  constexpr int kPoints = 256;
  const double root = std::sqrt(1.0 - correlation * correlation);
  const double b_squared = 0.5 * bit_energy_to_noise * (1.0 + root);
  const double share = std::sqrt((1.0 - root) / (1.0 + root));  // a / b
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double q = 1.0 + 2.0 * share * std::sin(2.0 * M_PI * i / kPoints) + share * share;
    sum += (1.0 - share * share) / q * std::exp(-0.5 * b_squared * q);
  }
  return std::clamp(0.5 * sum / kPoints, 0.0, 0.5);
}

double bit_error_probability(Modulation modulation, double ratio) {
  if (std::isinf(ratio)) return 0.0;
  if (modulation == Modulation::Oqpsk) return oqpsk_error(ratio);
  constexpr double kCorrelation = 2.0 / M_PI;  // of tones half a bit rate apart
  return correlated_fsk_error(ratio, kCorrelation);
}

}  // namespace rf_channel
