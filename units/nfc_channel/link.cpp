#include "units/nfc_channel/link.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace nfc_channel {
namespace {

double seconds_per_bit(std::uint32_t bit_rate) {
  return stride::to_seconds(nfc::bit_duration(bit_rate));
}

// What two low-passes in a row have done of a step after a time.
double step_response(double seconds, double tau_1, double tau_2) {
  const double longer = std::max(tau_1, tau_2);
  const double shorter = std::min(tau_1, tau_2);
  const double decay = std::exp(-seconds / longer);
  if (longer - shorter < 1e-6 * longer) return 1.0 - decay * (1.0 + seconds / longer);
  return 1.0 - (longer * decay - shorter * std::exp(-seconds / shorter)) / (longer - shorter);
}

double sideband_share(double quality) {
  const double detuning = 2.0 * quality * kSubcarrierFrequency / nfc::kCarrierFrequency;
  return 1.0 / (1.0 + detuning * detuning);
}

}  // namespace

double noise_density(const Noise& noise) {
  return kBoltzmann * noise.temperature + noise.interference / kInterferenceBandwidth;
}

BitSignal down_signal(std::uint32_t bit_rate, double reader_quality, double tag_quality) {
  const double pause = seconds_per_bit(bit_rate) / 4.0;
  const double depth = step_response(pause, 2.0 * reader_quality / kCarrierAngularFrequency,
                                     2.0 * tag_quality / kCarrierAngularFrequency);
  return {pause * depth * depth, false};
}

BitSignal up_signal(std::uint32_t bit_rate, double reader_quality, double tag_quality) {
  const bool manchester = bit_rate == 106;
  const double share = sideband_share(reader_quality) * sideband_share(tag_quality);
  return {seconds_per_bit(bit_rate) * (manchester ? 0.5 : 1.0) * share, !manchester};
}

double sideband_power(const Circuit& circuit, double mutual, const Operation& operation) {
  const Operation modulated = circuit.modulate(mutual, operation);
  return std::norm(operation.reader_current - modulated.reader_current) *
         circuit.reader().resistance / (M_PI * M_PI);
}

double signal_to_noise(double signal_power, const BitSignal& bit, double noise_density) {
  const double energy = signal_power * bit.seconds;
  if (!(energy > 0.0)) return 0.0;
  return noise_density > 0.0 ? energy / noise_density : std::numeric_limits<double>::infinity();
}

double bit_error_probability(double signal_to_noise, bool coherent) {
  const double ratio = std::max(signal_to_noise, 0.0);
  return coherent ? 0.5 * std::erfc(std::sqrt(ratio)) : 0.5 * std::exp(-0.5 * ratio);
}

}  // namespace nfc_channel
