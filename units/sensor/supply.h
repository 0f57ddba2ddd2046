// The circuit between the antenna and the loads, as long as nothing is switched in it.
#ifndef STRIDE_UNITS_SENSOR_SUPPLY_H
#define STRIDE_UNITS_SENSOR_SUPPLY_H

#include <array>
#include <cstddef>

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

/// How the currents flow.
///
/// The rectifier at the parallel resonant antenna is a current source up to the voltage of its
/// limiter (Wang, Covic, Stielau, "Power transfer capability and bifurcation phenomena of loosely
/// coupled inductive power transfer systems", IEEE Trans. Ind. Electron. 51(1), 2004; limiter:
/// Finkenzeller, RFID Handbook, 4.1.8). It offers I = efficiency * field power / maximum voltage,
/// which at the maximum voltage is all of the field's power. At a lower voltage it takes less.
///
/// The supercapacitor is a capacitance with a leakage resistance in parallel and a resistance in
/// series with both (Spyker, Nelms, "Classical equivalent circuit parameters for a double-layer
/// capacitor", IEEE Trans. Aerosp. Electron. Syst. 36(3), 2000). `voltage` is always that of the
/// capacitance; the terminal's differs by the drop in the series resistance.
///
/// The loads draw their currents through a linear regulator, so these flow from the rail unchanged.
///
/// If the rectifier offers more than the loads take, it holds the supply rail at the maximum
/// voltage and a linear charger passes on what is left: a constant current until the capacitor's
/// terminal has the maximum voltage, then this voltage. What is left over goes into the limiter. If
/// it offers less, the capacitor feeds the rail through an ideal diode.
struct Flow {
  enum class Mode { FromCapacitor, ConstantCurrent, ConstantVoltage };

  Mode mode = Mode::FromCapacitor;
  double field_power = 0;  ///< [W]
  double source = 0;       ///< what the rectifier offers [A]
  Currents parts{};
  double load = 0;     ///< their sum [A]
  double current = 0;  ///< into the capacitor, the most of it with Mode::ConstantVoltage [A]

  bool same_currents(const Flow& other) const {
    return field_power == other.field_power && parts == other.parts;
  }
};

class Supply {
 public:
  explicit Supply(const PowerParameters& parameters) : p_(parameters) {}

  Flow flow(double field_power, const Currents& parts, double voltage) const;

  /// The law that the voltage follows: it is linear in each mode, and in time the voltage rises, or
  /// falls, all the way.
  Relaxation capacitor(const Flow& flow) const;

  /// The voltage at which Mode::ConstantCurrent and Mode::ConstantVoltage meet.
  double knee(const Flow& flow) const;

  double current(const Flow& flow, double voltage) const;   ///< into the capacitor [A]
  double terminal(const Flow& flow, double voltage) const;  ///< voltage of the capacitor [V]
  double rail(const Flow& flow, double voltage) const;      ///< voltage of the supply rail [V]
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
  void add_charging(EnergyBooks& books, const Flow& flow, double voltage, double seconds) const;

  PowerParameters p_;
};

}  // namespace sensor

#endif
