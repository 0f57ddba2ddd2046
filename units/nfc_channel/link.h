// From coupling to power, from power to bit errors: the formulas of the radio link.
#ifndef STRIDE_UNITS_NFC_CHANNEL_LINK_H
#define STRIDE_UNITS_NFC_CHANNEL_LINK_H

namespace nfc_channel {

inline constexpr double kBoltzmann = 1.380649e-23;  ///< [J/K]

/// The share of the transmitter's power, 0 to 1, that two coupled resonant circuits bring into an
/// optimal load: U^2 / (1 + sqrt(1 + U^2))^2 with U = k sqrt(Q1 Q2). Kurs et al., "Wireless Power
/// Transfer via Strongly Coupled Magnetic Resonances", Science 317 (2007), where U is the coupling
/// rate over the geometric mean of the loss rates.
double link_efficiency(double coupling, double first_quality, double second_quality);

/// What disturbs a receiver.
struct Noise {
  double temperature;   ///< of the receiver's thermal noise [K]
  double interference;  ///< power in the receiver's band, whatever the bit rate [W]
};

/// The ratio of signal to noise power in a bandwidth as wide as the bit rate [bit/s], which is
/// Eb/N0. The noise power is k_B T B + interference; without any noise the ratio is infinite.
double signal_to_noise(double signal_power, const Noise& noise, double bit_rate);

/// The ratio in decibels, but not below -200 dB nor above 200 dB, so that it can be recorded.
double decibels(double ratio);

/// The probability that a bit is received wrong, 1/2 exp(-snr / 2): noncoherent detection of two
/// orthogonal signals (Proakis and Salehi, "Digital Communications", 5th ed., sect. 4.5). Type A's
/// symbols are such a pair: the pause of modified Miller code, and the subcarrier burst of
/// Manchester code, is in one half of the bit or in the other.
double bit_error_probability(double snr);

}  // namespace nfc_channel

#endif
