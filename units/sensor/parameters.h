// What can be set on a sensor: plain values in SI units, and one table of their names and ranges.
#ifndef STRIDE_UNITS_SENSOR_PARAMETERS_H
#define STRIDE_UNITS_SENSOR_PARAMETERS_H

#include <cstdint>

namespace sensor {

struct TransceiverParameters {
  std::int32_t fifo_depth = 4;       ///< commands that can wait for the control unit
  double transmit_current = 1.0e-3;  ///< of the load modulator while it transmits [A]
  double carrier_voltage = 3.0;      ///< rectified, from which on there is a carrier [V]; 0: it has
                                     ///< one of its own
  bool always_selected = true;       ///< answers all commands without having been selected
};

struct ControlUnitParameters {
  double clock_frequency = 50e6;         ///< [Hz]; its half period is rounded to a picosecond
  bool clock_gating = true;              ///< the clock is stopped while the control unit sleeps
  std::int32_t boot_cycles = 50'000;     ///< from power-on to the first instruction
  std::int32_t wake_up_cycles = 250;     ///< from stop mode to the first instruction
  std::int32_t decode_cycles = 40;       ///< to decode a command
  std::int32_t execute_cycles = 60;      ///< to do it, conversions not included
  std::int32_t cycles_per_byte = 24;     ///< to hand one byte of the answer to the transceiver
  double active_current = 2.0e-3;        ///< [A]
  double sleep_current = 2.0e-6;         ///< in stop mode, the rest of the device included [A]
  double timer_current = 0.3e-6;         ///< of the timer, in addition, while it samples [A]
  double led_current = 1.0e-3;           ///< [A]
  std::int32_t identifier = 0x53454E53;  ///< what Command::Identify answers
};

struct AdcParameters {
  double minimum = -40.0;                ///< the temperature of code 0 [degC]
  double maximum = 125.0;                ///< the temperature of code 4095 [degC]
  double offset_error = 0.0;             ///< so much too high it converts [K]
  std::int32_t conversion_cycles = 800;  ///< of the control unit's clock
  double current = 0.2e-3;               ///< while it converts [A]
};

struct PowerParameters {
  double antenna_resistance = 19.26e3;  ///< of the antenna's parallel resonance [Ohm]
  double rectifier_drop = 0.6;          ///< of the two diodes that conduct [V]
  double capacitance = 100e-6;          ///< [F]
  double series_resistance = 100;       ///< of the capacitor [Ohm]
  double leakage_resistance = 10e6;     ///< parallel to the capacitance [Ohm]
  double initial_voltage = 0.0;         ///< [V]
  double maximum_voltage = 5.0;         ///< of limiter, supply rail and capacitor [V]
  double charging_current = 10e-3;      ///< the most that the charger gives [A]
  double power_on_voltage = 3.0;        ///< [V]
  double start_up_delay = 1e-3;    ///< from power_on_voltage until the loads are switched on [s]
  double brown_out_voltage = 1.9;  ///< [V]
  double supply_voltage = 1.8;     ///< that the regulator gives to the loads [V]
};

struct SensorParameters {
  TransceiverParameters transceiver;
  ControlUnitParameters control_unit;
  AdcParameters adc;
  PowerParameters power;
};

/// One row of the table: the name, the unit of a double as FMI writes it, the range, both ends
/// included, and what it means.
struct ParameterInfo {
  const char* name;
  const char* unit;
  double minimum;
  double maximum;
  const char* description;
};

// For each parameter of a part: add(member, name, unit, minimum, maximum, description).

template <class Part, class Add>
void add_transceiver(Part& transceiver, const Add& add) {
  add(transceiver.fifo_depth, "transceiver.fifo_depth", "", 1, 1024,
      "commands that can wait for the control unit");
  add(transceiver.transmit_current, "transceiver.transmit_current", "A", 0, 1,
      "current of the load modulator while it transmits");
  add(transceiver.carrier_voltage, "transceiver.carrier_voltage", "V", 0, 100,
      "rectified voltage without load from which on there is a carrier to answer with; 0 if it has "
      "its own");
  add(transceiver.always_selected, "transceiver.always_selected", "", 0, 1,
      "whether all commands are answered without a selection");
}

template <class Part, class Add>
void add_control_unit(Part& control_unit, const Add& add) {
  add(control_unit.clock_frequency, "control_unit.clock_frequency", "Hz", 1e3, 1e9,
      "frequency of the control unit's clock");
  add(control_unit.clock_gating, "control_unit.clock_gating", "", 0, 1,
      "whether the clock is stopped while the control unit sleeps");
  add(control_unit.boot_cycles, "control_unit.boot_cycles", "", 1, 1e9,
      "clock cycles from power-on to the first instruction");
  add(control_unit.wake_up_cycles, "control_unit.wake_up_cycles", "", 1, 1e9,
      "clock cycles from stop mode to the first instruction");
  add(control_unit.decode_cycles, "control_unit.decode_cycles", "", 1, 1e9,
      "clock cycles to decode a command");
  add(control_unit.execute_cycles, "control_unit.execute_cycles", "", 1, 1e9,
      "clock cycles to execute a command, conversions not included");
  add(control_unit.cycles_per_byte, "control_unit.cycles_per_byte", "", 1, 1e9,
      "clock cycles to hand a byte of the answer to the transceiver");
  add(control_unit.active_current, "control_unit.active_current", "A", 0, 1,
      "current of the control unit while it is awake");
  add(control_unit.sleep_current, "control_unit.sleep_current", "A", 0, 1,
      "current in stop mode, the rest of the device included");
  add(control_unit.timer_current, "control_unit.timer_current", "A", 0, 1,
      "current of the timer, in addition, while samples are taken");
  add(control_unit.led_current, "control_unit.led_current", "A", 0, 1, "current of the LED");
  add(control_unit.identifier, "control_unit.identifier", "", -2147483648.0, 2147483647.0,
      "the 32-bit identifier, as a signed number");
}

template <class Part, class Add>
void add_adc(Part& adc, const Add& add) {
  add(adc.minimum, "adc.minimum", "degC", -273.15, 327, "temperature of code 0");
  add(adc.maximum, "adc.maximum", "degC", -273.15, 327, "temperature of code 4095");
  add(adc.offset_error, "adc.offset_error", "K", -100, 100,
      "by how much too high a temperature is converted, because calibration is missing");
  add(adc.conversion_cycles, "adc.conversion_cycles", "", 1, 1e9, "clock cycles of a conversion");
  add(adc.current, "adc.current", "A", 0, 1, "current while it converts");
}

template <class Part, class Add>
void add_power(Part& power, const Add& add) {
  add(power.antenna_resistance, "power.antenna_resistance", "Ohm", 1, 1e9,
      "resistance of the antenna's parallel resonance, its losses and the chip's");
  add(power.rectifier_drop, "power.rectifier_drop", "V", 0, 10,
      "voltage that the rectifier's two conducting diodes take");
  add(power.capacitance, "power.capacitance", "F", 1e-9, 100, "capacitance of the supercapacitor");
  add(power.series_resistance, "power.series_resistance", "Ohm", 1e-3, 1e6,
      "resistance in series with the supercapacitor");
  add(power.leakage_resistance, "power.leakage_resistance", "Ohm", 1, 1e18,
      "resistance parallel to the supercapacitor, through which it leaks");
  add(power.initial_voltage, "power.initial_voltage", "V", 0, 100, "voltage at the start");
  add(power.maximum_voltage, "power.maximum_voltage", "V", 1e-3, 100,
      "voltage of the limiter, to which the supercapacitor is charged");
  add(power.charging_current, "power.charging_current", "A", 1e-9, 100,
      "the most that the charger gives to the supercapacitor");
  add(power.power_on_voltage, "power.power_on_voltage", "V", 1e-3, 100,
      "voltage of the supercapacitor at which the device is switched on");
  add(power.start_up_delay, "power.start_up_delay", "s", 1e-6, 1000,
      "time from that voltage until the device is switched on");
  add(power.brown_out_voltage, "power.brown_out_voltage", "V", 1e-3, 100,
      "voltage of the supercapacitor at which the device is switched off");
  add(power.supply_voltage, "power.supply_voltage", "V", 1e-3, 100,
      "voltage that the linear regulator gives to the loads");
}

/// Calls visit(ParameterInfo, member) for each parameter, in a fixed order. The member is a double,
/// a std::int32_t or a bool; it is const if the parameters are.
template <class Parameters, class Visitor>
void visit_parameters(Parameters& parameters, Visitor&& visit) {
  auto& [transceiver, control_unit, adc, power] = parameters;
  const auto add = [&](auto& member, const char* name, const char* unit, double minimum,
                       double maximum, const char* description) {
    visit(ParameterInfo{name, unit, minimum, maximum, description}, member);
  };
  add_transceiver(transceiver, add);
  add_control_unit(control_unit, add);
  add_adc(adc, add);
  add_power(power, add);
}

/// Throws std::invalid_argument, which names the parameter, its value and its range, if one is out
/// of range or contradicts another.
void check(const SensorParameters& parameters);

}  // namespace sensor

#endif
