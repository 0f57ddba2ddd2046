// The two resonant circuits and what flows in them: from mutual inductance to power.
#ifndef STRIDE_UNITS_NFC_CHANNEL_CIRCUIT_H
#define STRIDE_UNITS_NFC_CHANNEL_CIRCUIT_H

#include <cmath>
#include <complex>

#include "units/nfc_channel/coil.h"

namespace nfc_channel {

inline constexpr double kCarrierAngularFrequency = 2.0 * M_PI * 13.56e6;

/// What a tag's chip does to its antenna's terminals.
struct TagChip {
  double capacitance;            ///< parallel to the coil [F]; 0 tunes the coil to the carrier
  double load_resistance;        ///< rectifier and all behind it, as a parallel resistance [Ohm]
  double voltage_limit;          ///< amplitude at which the limiter begins to shunt [V]
  double modulation_resistance;  ///< switched in parallel by the load modulator [Ohm]
};

/// The reader: a transmitter with an inner resistance, and its antenna in series resonance. The
/// transmitter is matched to the antenna as it is without a tag.
struct ReaderAntenna {
  double resistance;  ///< of the coil, and of the transmitter, too [Ohm]
  double reactance;   ///< of coil and series capacitor; 0 if tuned to the carrier [Ohm]
  double quality;     ///< of the circuit with the transmitter connected: half the coil's

  /// `capacitance` [F] in series with the coil, 0 tunes it to the carrier.
  ReaderAntenna(const Coil& coil, double capacitance);
};

/// The steady state at the carrier frequency. Currents and voltages are amplitudes, not effective
/// values.
struct Operation {
  std::complex<double> source_voltage;  ///< of the transmitter, before its inner resistance [V]
  std::complex<double> reader_current;  ///< [A]
  std::complex<double> tag_current;     ///< in the tag's coil [A]
  std::complex<double> tag_voltage;     ///< at the chip [V]
  double limiter_conductance;           ///< [S]
};

/// One reader's antenna and one tag, coupled by the mutual inductance M:
///
///     V = (R + R1 + jX1) I1 - j omega M I2        transmitter and reader's coil, R = R1
///     j omega M I1 = (R2 + j omega L2) I2 + U     tag's coil
///     I2 = (j omega C2 + 1/RL + Gs) U             chip: capacitor, load, limiter
///
/// (Finkenzeller, "RFID Handbook", 3rd ed., sect. 4.1.6 to 4.1.10.) The carrier power P is what the
/// transmitter can give at most, V^2 = 8 R P, and what it does give where no tag changes the
/// match; a tag's reflected impedance (omega M)^2 / Z2 lets it give less. So no power is made:
/// load, limiter and both coils together get what goes into the antenna, which is at most P.
///
/// Seen from the chip all but the limiter is linear, so that the shunt conductance Gs which holds
/// the voltage at its limit has a closed form.
class Circuit {
 public:
  Circuit(const ReaderAntenna& reader, const Coil& tag_coil, const TagChip& chip);

  /// `limited` = false: as though the limiter were not there.
  Operation operate(double mutual_inductance, double carrier_power, bool limited = true) const;

  /// The same with the load modulator switched on. The limiter is too slow to follow it, and keeps
  /// the conductance that it has in `unmodulated`.
  Operation modulate(double mutual_inductance, const Operation& unmodulated) const;

  // Where the power goes [W].
  double into_antenna(const Operation& operation) const;  ///< all that leaves the transmitter
  double in_reader_coil(const Operation& operation) const;
  double in_tag_coil(const Operation& operation) const;
  double in_load(const Operation& operation) const;
  double in_limiter(const Operation& operation) const;

  /// The quality factor of the tag's circuit with its load, without limiter.
  double tag_quality() const;
  const ReaderAntenna& reader() const { return reader_; }

 private:
  Operation solve(double mutual_inductance, std::complex<double> source_voltage,
                  double limiter_conductance, double conductance) const;

  ReaderAntenna reader_;
  double tag_reactance_;    // of the coil
  double tag_resistance_;   // of the coil
  double tag_susceptance_;  // of the capacitor
  TagChip chip_;
};

}  // namespace nfc_channel

#endif
