// The power unit: rectifier, charger, supercapacitor and brown-out detector.
#ifndef STRIDE_UNITS_SENSOR_POWER_UNIT_H
#define STRIDE_UNITS_SENSOR_POWER_UNIT_H

#include <systemc>

#include <stride/time.h>

#include "units/sensor/parameters.h"
#include "units/sensor/storage.h"

namespace sensor {

/// Where energy has gone since the start [J]: intake = load + leakage + what is stored since.
struct EnergyBooks {
  double intake = 0;
  double load = 0;
  double leakage = 0;
};

/// Event driven. Between events each power is constant and the capacitor's energy has a closed
/// form; the instant at which it reaches a threshold is computed and scheduled, so that nothing is
/// polled and nothing depends on how the simulation is cut into steps.
///
/// The load's power is the sum of the currents times the supply voltage over the regulator's
/// efficiency. The rectifier gives a constant share of the field's power; once the capacitor is
/// full the charger takes only what the load and the leakage use.
class PowerUnit : public sc_core::sc_module {
 public:
  sc_core::sc_in<double> field_power{"field_power"};  ///< at the antenna [W], not negative
  sc_core::sc_in<double> control_unit_current{"control_unit_current"};  ///< [A]
  sc_core::sc_in<double> transceiver_current{"transceiver_current"};    ///< [A]
  sc_core::sc_in<double> adc_current{"adc_current"};                    ///< [A]
  sc_core::sc_in<double> led_current{"led_current"};                    ///< [A]
  sc_core::sc_out<bool> powered{"powered"};
  sc_core::sc_out<double> energy_intake{"energy_intake"};  ///< taken by the charger [W]
  sc_core::sc_out<double> energy_load{"energy_load"};      ///< drawn from the capacitor [W]
  sc_core::sc_out<double> charge{"charge"};                ///< at the last power event [C]
  sc_core::sc_out<double> voltage{"voltage"};              ///< at the last power event [V]

  PowerUnit(sc_core::sc_module_name name, const PowerParameters& parameters);

  // At the current instant, between events too.
  double energy_now() const;            ///< [J]
  double charge_now() const;            ///< [C]
  double voltage_now() const;           ///< [V]
  double charging_current_now() const;  ///< into the capacitor, less its leakage [A]
  EnergyBooks books_now() const;

 private:
  enum class Threshold { kNone, kPowerOn, kBrownOut, kFull };

  void on_power_event();
  void settle_books();
  void arrive();
  void take_powers();
  void schedule();
  void publish();

  double seconds_since_event() const;
  double threshold_energy(Threshold threshold) const;

  PowerParameters parameters_;
  Storage storage_;
  sc_core::sc_event crossing_{"crossing"};

  stride::Time last_event_;
  double energy_;
  double intake_ = 0;
  double load_ = 0;
  bool on_ = false;
  bool full_ = false;
  Threshold next_ = Threshold::kNone;
  stride::Time next_instant_;
  EnergyBooks books_;
};

}  // namespace sensor

#endif
