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
  double capacitance;    ///< parallel to the coil [F]; 0 tunes the coil to the carrier
  double voltage_limit;  ///< the greatest amplitude [V]; rectifier and limiter hold it there
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
  double chip_conductance;              ///< of rectifier and limiter [S]
};

/// What a tag's antenna is to its chip: a source behind a resistance.
struct Source {
  double voltage;          ///< amplitude without load [V]
  double available_power;  ///< what the best resistive load gets [W]
};

/// One reader's antenna and one tag, coupled by the mutual inductance M:
///
///     V = (R + R1 + jX1) I1 - j omega M I2        transmitter and reader's coil, R = R1
///     j omega M I1 = (R2 + j omega L2) I2 + U     tag's coil
///     I2 = (j omega C2 + Gs) U                    chip: capacitor, rectifier and limiter
///
/// (Finkenzeller, "RFID Handbook", 3rd ed., sect. 4.1.6 to 4.1.10.) The carrier power P is what the
/// transmitter can give at most, V^2 = 8 R P, and what it does give where no tag changes the
/// match; a tag's reflected impedance (omega M)^2 / Z2 lets it give less. So no power is made:
/// chip and both coils together get what goes into the antenna, which is at most P.
///
/// A rectifier takes nothing below the voltage of its rail and all it can above it. At the limit
/// all that the antenna can give goes into the chip, what its loads do not take into the limiter,
/// so the chip's sum does not depend on the loads; below it the chip is taken for one that only
/// listens. Seen from the chip all else is linear, so that the conductance Gs which holds the
/// voltage at its limit has a closed form, and the antenna is a source.
class Circuit {
 public:
  Circuit(const ReaderAntenna& reader, const Coil& tag_coil, const TagChip& chip);

  Operation operate(double mutual_inductance, double carrier_power) const;

  /// What the chip's rectifier has before it: the antenna with its tuned capacitor. A resistive
  /// load RL = 1 / Gs gets U^2 / (2 RL), most with Gs = |Y|, Y the admittance of antenna and
  /// capacitor: |I|^2 / (4 (|Y| + Re Y)), I the source's current.
  Source source(double mutual_inductance, double carrier_power) const;

  /// As operate(), with the load modulator switched on. Rectifier and limiter are too slow to
  /// follow it, and keep the conductance that they have in `unmodulated`.
  Operation modulate(double mutual_inductance, const Operation& unmodulated) const;

  // Where the power goes [W].
  double into_antenna(const Operation& operation) const;  ///< all that leaves the transmitter
  double in_reader_coil(const Operation& operation) const;
  double in_tag_coil(const Operation& operation) const;
  double in_chip(const Operation& operation) const;

  /// Of the tuned tag's circuit alone, the resistance parallel to it [Ohm]: Q omega L (1 + 1 /
  /// Q^2).
  double tag_resistance() const;
  /// The quality factor of the tag's circuit while nothing conducts in its chip: that of its coil.
  double tag_quality() const;
  /// Of a tag that modulates its load with the subcarrier: with the mean of its conductances with
  /// and without modulation resistance, rectifier and limiter left out.
  double modulated_quality() const;
  const ReaderAntenna& reader() const { return reader_; }

 private:
  // A current [A] and the admittance parallel to it [S].
  struct Norton {
    double current;
    std::complex<double> admittance;
  };
  Norton antenna(double mutual_inductance, double carrier_power) const;
  double source_voltage(double carrier_power) const;
  Operation solve(double mutual_inductance, std::complex<double> source_voltage,
                  double chip_conductance, double modulation_conductance) const;

  ReaderAntenna reader_;
  double tag_reactance_;    // of the coil
  double tag_resistance_;   // of the coil
  double tag_susceptance_;  // of the capacitor
  TagChip chip_;
};

}  // namespace nfc_channel

#endif
