// What can be set on a channel: one reader, and the tags that it may meet.
#ifndef STRIDE_UNITS_NFC_CHANNEL_PARAMETERS_H
#define STRIDE_UNITS_NFC_CHANNEL_PARAMETERS_H

#include <cstdint>
#include <vector>

#include "units/channel/names.h"
#include "units/nfc_channel/circuit.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/link.h"

namespace nfc_channel {

struct ReaderParameters {
  Coil coil{0.030, 4, 0.5e-3, 0.0, 15.0};
  double capacitance = 0.0;  ///< in series with the coil [F]; 0 tunes it to the carrier
  Noise noise{290.0, 2e-11};
  double sensitivity = 1e-12;   ///< a reader that receives less does not demodulate [W]
  double capture_ratio = 10.0;  ///< a tag stronger by more than this masks another [dB]
};

struct TagParameters {
  channel::TagName name;
  Coil coil{0.008, 12, 0.1e-3, 0.0, 35.0};
  TagChip chip{0.0, 5.6, 500.0};
  double rectifier_drop = 0.6;       ///< of the rectifier's two conducting diodes [V]
  double demodulator_voltage = 3.0;  ///< rectified, that the demodulator needs [V]
  Noise noise{290.0, 3e-7};
};

struct Parameters {
  ReaderParameters reader;
  std::vector<TagParameters> tags = std::vector<TagParameters>(1);
  std::uint64_t seed = 1;        ///< of the bit errors
  std::uint32_t bit_rate = 106;  ///< for which a Link has its ratios [kbit/s]
};

/// Throws std::invalid_argument, which names the parameter, its value and its range, if one is out
/// of range or there is no tag.
void check(const Parameters& parameters);

}  // namespace nfc_channel

#endif
