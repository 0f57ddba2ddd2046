// The power unit: rectifier, limiter, charger, supercapacitor, regulator and supervisor.
#ifndef STRIDE_UNITS_SENSOR_POWER_UNIT_H
#define STRIDE_UNITS_SENSOR_POWER_UNIT_H

#include <optional>
#include <systemc>

#include <stride/systemc/timer.h>
#include <stride/time.h>

#include "units/sensor/parameters.h"
#include "units/sensor/supply.h"

namespace sensor {

/// Event driven. Between events each current of Flow follows a closed form; the instant at which a
/// voltage reaches a threshold is computed and scheduled, so that nothing is polled and nothing
/// depends on how the simulation is cut into steps.
///
/// The supervisor watches the voltage at the capacitor's terminal. The device is switched on when
/// that has reached power_on_voltage, after start_up_delay, unless it has fallen to
/// brown_out_voltage meanwhile; at brown_out_voltage it is switched off at once. So the drop that
/// the device's own current causes can switch it on and off again and again, but no faster than the
/// delay.
class PowerUnit : public sc_core::sc_module {
 public:
  sc_core::sc_in<double> field_power{"field_power"};  ///< at the antenna [W], not negative
  sc_core::sc_in<double> control_unit_current{"control_unit_current"};  ///< [A]
  sc_core::sc_in<double> transceiver_current{"transceiver_current"};    ///< [A]
  sc_core::sc_in<double> adc_current{"adc_current"};                    ///< [A]
  sc_core::sc_in<double> led_current{"led_current"};                    ///< [A]
  sc_core::sc_out<bool> powered{"powered"};
  // As they are right after the last power event.
  sc_core::sc_out<double> energy_intake{"energy_intake"};  ///< rectified and not shunted [W]
  sc_core::sc_out<double> energy_load{"energy_load"};      ///< of regulator and parts [W]
  sc_core::sc_out<double> charge{"charge"};                ///< [C]
  sc_core::sc_out<double> voltage{"voltage"};              ///< of the supply rail [V]

  PowerUnit(sc_core::sc_module_name name, const PowerParameters& parameters);

  // At the current instant, between events too.
  double charge_now() const;            ///< [C]
  double terminal_voltage_now() const;  ///< of the capacitor [V]
  double rail_voltage_now() const;      ///< [V]
  double drawn_now() const;             ///< [W]
  double intake_now() const;            ///< [W]
  double load_now() const;              ///< [W]
  double stored_now() const;           ///< energy that the capacitor has gained since the start [J]
  EnergyBooks books_now() const;       ///< since the start
  PowerReadings readings_now() const;  ///< all of these
  PowerReadings rates_now() const;     ///< their first derivatives
  PowerReadings curvatures_now() const;  ///< see Supply::curvatures()

 private:
  enum class Threshold { PowerGood, BrownOut, Knee };
  struct Crossing {
    Threshold threshold;
    stride::Time instant;
  };

  void on_power_event();
  void settle();
  void arrive();
  void take_currents();
  void supervise();
  void power_good();
  void brown_out();
  void schedule();
  void publish();

  Currents currents() const;
  double terminal() const { return supply_.terminal(flow_, voltage_); }
  double seconds_since_event() const;
  double voltage_now() const;  ///< of the capacitance
  std::optional<Crossing> next_crossing() const;

  PowerParameters parameters_;
  Supply supply_;
  stride::systemc::Timer crossing_timer_{"crossing_timer"};
  stride::systemc::Timer start_up_timer_{"start_up_timer"};

  stride::Time last_event_;
  double voltage_;  ///< of the capacitance at the last event
  Flow flow_;       ///< since then
  EnergyBooks books_;
  bool good_;  ///< the voltage has reached power_on_voltage, and not brown_out_voltage since
  bool on_;
  stride::Time start_up_;
  std::optional<Crossing> crossing_;
  bool at_knee_ = false;
};

}  // namespace sensor

#endif
