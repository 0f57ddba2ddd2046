// The circuit between the antenna and the loads, as long as nothing is switched in it.
#ifndef STRIDE_UNITS_SENSOR_SUPPLY_H
#define STRIDE_UNITS_SENSOR_SUPPLY_H

#include <array>
#include <cstddef>
#include <optional>

#include "units/sensor/parameters.h"
#include "units/sensor/relaxation.h"

namespace sensor {

/// The parts that draw a current from the regulator.
enum Part : std::size_t { kControlUnit, kTransceiver, kAdc, kLed, kParts };
using Currents = std::array<double, kParts>;  ///< of each part [A]

/// Where energy has gone [J]: field = stored + all others, stored being what the capacitor has
/// gained. Each is an integral of its own, so that the equation holds to rounding only.
struct EnergyBooks {
  double field = 0;                    ///< taken from the antenna
  double rectifier = 0;                ///< lost in it
  double limiter = 0;                  ///< shunted to ground, because it is not used
  double charger = 0;                  ///< lost between supply rail and capacitor
  double series_resistance = 0;        ///< lost in that of the capacitor
  double leakage = 0;                  ///< lost in the capacitor's leakage
  double regulator = 0;                ///< lost between supply rail and parts
  std::array<double, kParts> parts{};  ///< used by each

  EnergyBooks& operator+=(const EnergyBooks& other);
  double all_but_field_and_stored() const;
};

/// What can be read off the power unit: values, or what these do in a second.
struct PowerReadings {
  double charge = 0;    ///< of the capacitor [C]
  double terminal = 0;  ///< voltage of the capacitor [V]
  double rail = 0;      ///< voltage of the supply rail [V]
  double drawn = 0;     ///< from the antenna [W]
  double intake = 0;    ///< rectified and not shunted [W]
  double load = 0;      ///< of regulator and parts [W]
  double stored = 0;    ///< energy that the capacitor has gained since the start [J]
  EnergyBooks books;    ///< since the start
};

/// Calls visit(a's, b's) for each reading.
template <class A, class B, class Visitor>
void visit_pairs(A& a, B& b, Visitor&& visit) {
  visit(a.charge, b.charge);
  visit(a.terminal, b.terminal);
  visit(a.rail, b.rail);
  visit(a.drawn, b.drawn);
  visit(a.intake, b.intake);
  visit(a.load, b.load);
  visit(a.stored, b.stored);
  visit(a.books.field, b.books.field);
  visit(a.books.rectifier, b.books.rectifier);
  visit(a.books.limiter, b.books.limiter);
  visit(a.books.charger, b.books.charger);
  visit(a.books.series_resistance, b.books.series_resistance);
  visit(a.books.leakage, b.books.leakage);
  visit(a.books.regulator, b.books.regulator);
  for (std::size_t i = 0; i < kParts; ++i) visit(a.books.parts[i], b.books.parts[i]);
}

/// What the rectifier offers, seen from the rail: a voltage behind a resistance.
///
/// The antenna is a parallel resonance, a source of the amplitude U0 behind the resistance Rp, and
/// can deliver P = U0^2 / (8 Rp) at most (Finkenzeller, RFID Handbook, 4.1.7 to 4.1.9). Its quality
/// keeps the voltage a sine. A full bridge takes current at the sine's peaks only, where two diodes
/// and the rail have its amplitude U = V + drop. Short pulses of the mean I have a fundamental of
/// the amplitude 2 I (their Fourier series), so U = U0 - 2 I Rp, and
///
///     V = (U0 - drop) - 2 Rp I.
///
/// The antenna gives U * 2 I / 2 = (V + drop) I, which is what rail and diodes take: nothing is
/// lost or made.
struct Source {
  double voltage = 0;     ///< without load [V]
  double resistance = 1;  ///< [Ohm]

  double current_at(double rail) const { return (voltage - rail) / resistance; }
  bool operator==(const Source& other) const {
    return voltage == other.voltage && resistance == other.resistance;
  }
};

/// How the currents flow.
///
/// The supercapacitor is a capacitance with a leakage resistance in parallel and a resistance in
/// series with both (Spyker, Nelms, "Classical equivalent circuit parameters for a double-layer
/// capacitor", IEEE Trans. Aerosp. Electron. Syst. 36(3), 2000). `voltage` is always that of the
/// capacitance; the terminal's differs by the drop in the series resistance.
///
/// The loads draw their currents through a linear regulator, so these flow from the rail unchanged.
///
/// If the rectifier offers more than the loads take at the maximum voltage, the rail has this
/// voltage, and a linear charger passes on what is left: a constant current until the capacitor's
/// terminal has the maximum voltage, then this voltage. What is left over goes into the limiter.
/// The charger works at the maximum voltage only: in a weaker field the rail has the voltage at
/// which the rectifier offers what the loads take, and where that is less than the capacitor's, the
/// capacitor feeds the rail through an ideal diode, together with the rectifier or alone.
///
/// All of it is linear in each mode, so nothing is iterated.
struct Flow {
  enum class Mode { FromCapacitor, FromBoth, FromField, ConstantCurrent, ConstantVoltage };

  Mode mode = Mode::FromCapacitor;
  Source source;
  Currents parts{};
  double load = 0;      ///< their sum [A]
  double offer = 0;     ///< what the rectifier gives at the maximum voltage [A]
  double current = 0;   ///< into the capacitor, with FromCapacitor and ConstantCurrent [A]
  double floating = 0;  ///< the rail's voltage where the rectifier alone feeds the loads [V]

  bool same_currents(const Flow& other) const {
    return source == other.source && parts == other.parts;
  }
  bool is_charging() const {
    return mode == Mode::ConstantCurrent || mode == Mode::ConstantVoltage;
  }
};

class Supply {
 public:
  explicit Supply(const PowerParameters& parameters) : p_(parameters) {}

  /// Of a field from which the antenna can deliver this power [W].
  Source source(double field_power) const;
  /// The power [W] with which that voltage is so many volts; 0 for none.
  double field_power_for(double rectified) const;
  Flow flow(double field_power, const Currents& parts, double voltage) const;

  /// The law that the voltage follows: it is linear in each mode, and in time the voltage rises, or
  /// falls, all the way.
  Relaxation capacitor(const Flow& flow) const;

  /// The voltage at which the mode ends, if the voltage gets there, and the mode that follows:
  /// ConstantCurrent ends where it rises to it, all others where it falls to it. None for
  /// FromField.
  std::optional<double> knee(const Flow& flow) const;
  static Flow::Mode after_knee(Flow::Mode mode);

  double current(const Flow& flow, double voltage) const;   ///< into the capacitor [A]
  double terminal(const Flow& flow, double voltage) const;  ///< voltage of the capacitor [V]
  double rail(const Flow& flow, double voltage) const;      ///< voltage of the supply rail [V]
  double drawn(const Flow& flow, double voltage) const;     ///< from the antenna [W]
  double intake(const Flow& flow, double voltage) const;    ///< rectified and not shunted [W]
  double load(const Flow& flow, double voltage) const;      ///< regulator and parts [W]

  /// The voltage at which the terminal has the given one. Not for Mode::ConstantVoltage.
  double voltage_for_terminal(const Flow& flow, double terminal) const;

  /// Where the energy goes in a time in which the flow stays as it is.
  EnergyBooks books(const Flow& flow, double voltage, double seconds) const;

  /// The first derivative of each reading.
  PowerReadings rates(const Flow& flow, double voltage) const;
  /// A bound of the second derivative of each reading, absolute, from now on as long as the flow
  /// stays as it is: the voltage's slope falls, and so does what is a multiple of it.
  PowerReadings curvatures(const Flow& flow, double voltage) const;

 private:
  EnergyBooks powers(const Flow& flow, double voltage) const;
  double leakage_rate() const { return 1 / (p_.leakage_resistance * p_.capacitance); }
  /// Of source and capacitor in series.
  double loop_resistance(const Flow& flow) const {
    return flow.source.resistance + p_.series_resistance;
  }
  double rectified(const Flow& flow, double voltage) const;
  void add_feeding(EnergyBooks& books, const Flow& flow, double voltage, double seconds) const;
  void add_sharing(EnergyBooks& books, const Flow& flow, double voltage, double seconds) const;
  void add_sharing_bounds(PowerReadings& bounds, const Flow& flow, double voltage) const;
  void add_charging(EnergyBooks& books, const Flow& flow, double voltage, double seconds) const;

  PowerParameters p_;
};

}  // namespace sensor

#endif
