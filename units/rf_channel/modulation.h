// How bits become a packet, and how often they are wrong.
#ifndef STRIDE_UNITS_RF_CHANNEL_MODULATION_H
#define STRIDE_UNITS_RF_CHANNEL_MODULATION_H

#include <cstddef>
#include <cstdint>

#include <stride/time.h>

namespace rf_channel {

enum class Modulation : std::int64_t {
  Oqpsk = 0,  ///< IEEE 802.15.4, O-QPSK PHY in the 2450 MHz band, 250 kbit/s
  Gfsk = 1,   ///< as Bluetooth Low Energy, LE 1M
};

/// What a packet has around its bits, and how fast they are.
struct PacketFormat {
  stride::Duration header;    ///< preamble and all that comes before the bits
  std::uint32_t header_bits;  ///< of it, those that have to be heard right
  stride::Duration symbol;
  std::uint32_t bits_per_symbol;
  std::size_t most_octets;  ///< that a packet carries
  double bandwidth;         ///< of the receiver [Hz]
};

/// O-QPSK: preamble of 4 octets, start of frame delimiter and length of one octet each, symbols of
/// 4 bits in 16 us (IEEE Std 802.15.4-2020, 12.1 and 12.2), a receiver of 2 MHz. GFSK: preamble of
/// one octet, access address of 4 and header of 2, 1 us per bit (Bluetooth Core Specification 5.4,
/// vol. 6 part B, 2.1), a receiver of 1 MHz. Neither has a check sequence of its own here, since
/// the frame that it carries ends with one.
const PacketFormat& packet_format(Modulation modulation);

/// The probability that a bit is wrong, 0 to 0.5, for a ratio of signal to noise and interference
/// in the receiver's bandwidth, linear.
///
/// O-QPSK: 8/15 1/16 sum over k = 2..16 of (-1)^k (16 over k) exp(20 S (1/k - 1)) (IEEE Std
/// 802.15.4-2006, E.4.1.8). GFSK: noncoherent detection of two equally strong signals whose
/// correlation is that of two tones, sin(pi h) / (pi h) (J. G. Proakis, M. Salehi, "Digital
/// Communications", 5th ed., section 4.5-3), with the modulation index h = 0.5, what the Gaussian
/// filter does to the bits left out; Eb/N0 is S, since the bandwidth in Hz is the bit rate in
/// bit/s.
double bit_error_probability(Modulation modulation, double ratio);

/// Q_1(a, b) - 1/2 exp(-(a^2 + b^2) / 2) I_0(a b) with a^2, b^2 = Eb/(2 N0) (1 -+ sqrt(1 - r^2)),
/// as an integral over one period of a smooth function (M. K. Simon, M.-S. Alouini, "Digital
/// Communication over Fading Channels", 2nd ed., eq. 8.74), for which the trapezoidal rule
/// converges exponentially. `correlation` r is from 0 to less than 1.
double correlated_fsk_error(double bit_energy_to_noise, double correlation);

}  // namespace rf_channel

#endif
