// The NFC smart sensor: transceiver, control unit, ADC and power unit, wired together.
#ifndef STRIDE_UNITS_SENSOR_SENSOR_H
#define STRIDE_UNITS_SENSOR_SENSOR_H

#include <cstdint>
#include <systemc>

#include "units/sensor/adc.h"
#include "units/sensor/command_fifo.h"
#include "units/sensor/control_unit.h"
#include "units/sensor/gated_clock.h"
#include "units/sensor/parameters.h"
#include "units/sensor/power_unit.h"
#include "units/sensor/transceiver.h"

namespace sensor {

/// The device under test. Its inputs are the signals field_power and temperature, to be written
/// from outside, and the frames that reach the transceiver; its answers come through
/// transceiver.on_transmit. All signals can be read at any time.
class Sensor : public sc_core::sc_module {
 public:
  /// Throws std::invalid_argument if the parameters are not valid.
  Sensor(sc_core::sc_module_name name, const SensorParameters& parameters);

  /// No command is queued, no frame on the air or about to be, and the control unit sleeps or has
  /// no power: until a timer goes off nothing happens, but that a clock without a gate goes on.
  bool idle() const;

  // Inputs.
  sc_core::sc_signal<double> field_power{"field_power"};  ///< at the antenna [W]
  sc_core::sc_signal<double> temperature{"temperature"};  ///< at the ADC [degC]

  // Named as in the paper.
  sc_core::sc_signal<sc_dt::uint64> received_data{"recData"};
  sc_core::sc_signal<sc_dt::uint64> answer_data{"DataUCToTrm"};
  sc_core::sc_signal<double> energy_intake{"EnergyIntake"};  ///< [W]
  sc_core::sc_signal<double> energy_load{"EnergyLoad"};      ///< [W]
  sc_core::sc_signal<double> charge{"Charge"};               ///< at the last power event [C]
  sc_core::sc_signal<double> voltage{
      "Voltage"};  ///< of the supply rail, at the last power event [V]

  sc_core::sc_signal<bool> carrier{"carrier"};
  sc_core::sc_signal<bool> powered{"powered"};
  sc_core::sc_signal<bool> awake{"awake"};
  sc_core::sc_signal<bool> clock{"clock"};
  sc_core::sc_signal<bool> led{"led"};
  sc_core::sc_signal<bool> adc_start{"adc_start"};
  sc_core::sc_signal<bool> adc_busy{"adc_busy"};
  sc_core::sc_signal<std::int32_t> adc_code{"adc_code"};

 private:
  sc_core::sc_signal<double> control_unit_current_{"control_unit_current"};
  sc_core::sc_signal<double> transceiver_current_{"transceiver_current"};
  sc_core::sc_signal<double> adc_current_{"adc_current"};
  sc_core::sc_signal<double> led_current_{"led_current"};

 public:
  CommandFifo fifo;
  Transceiver transceiver;
  GatedClock gated_clock;
  ControlUnit control_unit;
  Adc adc;
  PowerUnit power_unit;

 private:
  void wire_transceiver();
  void wire_control_unit();
  void wire_adc();
  void wire_power_unit();
};

/// Calls visit(signal) for each signal that may be traced: `visit` calls sc_trace, say. The name of
/// a signal is signal.name().
template <class Visitor>
void visit_signals(const Sensor& sensor, Visitor&& visit) {
  visit(sensor.received_data);
  visit(sensor.answer_data);
  visit(sensor.energy_intake);
  visit(sensor.energy_load);
  visit(sensor.charge);
  visit(sensor.voltage);
  visit(sensor.field_power);
  visit(sensor.temperature);
  visit(sensor.carrier);
  visit(sensor.powered);
  visit(sensor.awake);
  visit(sensor.clock);
  visit(sensor.led);
  visit(sensor.adc_start);
  visit(sensor.adc_busy);
  visit(sensor.adc_code);
}

}  // namespace sensor

#endif
