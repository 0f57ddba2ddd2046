// From power to bit errors: the modulation of both directions, noise, detection.
#ifndef STRIDE_UNITS_NFC_CHANNEL_LINK_H
#define STRIDE_UNITS_NFC_CHANNEL_LINK_H

#include <cstdint>

#include "units/nfc_channel/circuit.h"

namespace nfc_channel {

inline constexpr double kBoltzmann = 1.380649e-23;                 ///< [J/K]
inline constexpr double kSubcarrierFrequency = 13.56e6 / 16.0;     ///< [Hz]
inline constexpr double kInterferenceBandwidth = 13.56e6 / 128.0;  ///< [Hz]

/// What disturbs a receiver: white within the bands that matter here.
struct Noise {
  double temperature;   ///< of the receiver's thermal noise [K]
  double interference;  ///< of other sources, within kInterferenceBandwidth [W]
};

/// Noise power per bandwidth [W/Hz]: k_B T + interference / kInterferenceBandwidth.
double noise_density(const Noise& noise);

/// How much of a bit's time the signal is there with which the bit is encoded, and how it is
/// detected.
struct BitSignal {
  double seconds;  ///< that the signal lasts, times the share of its power that gets through
  bool coherent;   ///< the phase is known; otherwise only the envelope is looked at
};

/// Reader to tag: amplitude shift keying of 100 %, modified Miller code (ISO/IEC 14443-2:2020,
/// 8.1.2 and 8.1.3.1). A bit is encoded by where in it the pause is, if any; the pause lasts a
/// quarter of the bit at each of the rates 106, 212, 424 and 848 kbit/s (t1 in 8.1.2.2
/// and 8.1.2.3). The two resonances let the envelope fall no further than two low-passes of the
/// time constants tau = 2 Q / omega in a row do in this time; the signal is that difference.
BitSignal down_signal(std::uint32_t bit_rate, double reader_quality, double tag_quality);

/// Tag to reader: load modulation with the subcarrier fc/16 (8.2.2 and 8.2.3); at 106 kbit/s on-off
/// keying in Manchester code, a burst in one half of the bit or in the other; at the higher rates
/// phase shift keying of the subcarrier by the bit itself, NRZ-L (8.2.4 and 8.2.6). Each resonance
/// passes the share 1 / (1 + (2 Q fs / fc)^2) of the sidebands' power.
BitSignal up_signal(std::uint32_t bit_rate, double reader_quality, double tag_quality);

/// The power [W] of both sidebands at the reader's receiver, which is the transmitter's inner
/// resistance R, as long as the resonances pass them whole: switching a current I between two
/// values with the subcarrier's frequency makes two sidebands of the amplitude |dI| / pi each
/// (Fourier series of a square wave; Finkenzeller, "RFID Handbook", 3rd ed., sect. 4.1.10.3 and
/// 3.2.1.2.1), so P = |dI|^2 R / pi^2.
double sideband_power(const Circuit& circuit, double mutual_inductance, const Operation& operation);

/// Eb / N0 of a bit, linear; infinite without noise.
double signal_to_noise(double signal_power, const BitSignal& bit, double noise_density);

/// The probability that a bit is received wrong. Not coherent: 1/2 exp(-x / 2), the detection of
/// two orthogonal signals by their envelopes, which type A's halves of a bit are. Coherent: 1/2
/// erfc(sqrt(x)), two opposite phases. (Proakis and Salehi, "Digital Communications", 5th ed.,
/// sections 4.5 and 4.2.)
double bit_error_probability(double signal_to_noise, bool coherent);

}  // namespace nfc_channel

#endif
