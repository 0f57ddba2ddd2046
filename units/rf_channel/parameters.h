// What can be set on a channel: one reader's radio, and those of the tags that it may meet.
#ifndef STRIDE_UNITS_RF_CHANNEL_PARAMETERS_H
#define STRIDE_UNITS_RF_CHANNEL_PARAMETERS_H

#include <cstdint>
#include <vector>

#include "units/channel/names.h"
#include "units/rf_channel/modulation.h"
#include "units/rf_channel/propagation.h"

namespace rf_channel {

/// The antenna and the receiver of one side.
struct Radio {
  double antenna_gain = 0.0;   ///< in its best direction, over an isotropic antenna [dB]
  double noise_figure = 10.0;  ///< over the thermal noise of 290 K [dB]
  double interference = 0.0;   ///< power of other senders in the receiver's bandwidth [W]
  double sensitivity = 1e-13;  ///< a receiver with less receives nothing [W]
};

struct TagParameters {
  channel::TagName name;
  Radio radio;
  double transmit_power = 1e-3;  ///< [W]
};

struct Parameters {
  Radio reader;
  std::vector<TagParameters> tags = std::vector<TagParameters>(1);
  double frequency = 2.45e9;  ///< of the carrier [Hz]
  Modulation modulation = Modulation::Oqpsk;
  Antenna antenna = Antenna::IsotropicVertical;
  Ground ground;
  std::uint64_t seed = 1;  ///< of the bit errors
};

/// Throws std::invalid_argument, which names the parameter, its value and its range, if one is out
/// of range or there is no tag.
void check(const Parameters& parameters);

/// Noise and interference of a receiver [W]: k_B T_0 B F + I, T_0 = 290 K, with the noise figure F
/// (H. T. Friis, "Noise Figures of Radio Receivers", Proc. IRE 32, 1944).
double noise_power(const Radio& radio, double bandwidth);

}  // namespace rf_channel

#endif
