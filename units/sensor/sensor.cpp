#include "units/sensor/sensor.h"

namespace sensor {
namespace {

const SensorParameters& checked(const SensorParameters& parameters) {
  check(parameters);
  return parameters;
}

double carrier_power(const SensorParameters& parameters) {
  return Supply(parameters.power).field_power_for(parameters.transceiver.carrier_voltage);
}

}  // namespace

Sensor::Sensor(sc_core::sc_module_name name, const SensorParameters& parameters)
    : sc_module(name),
      fifo(static_cast<std::size_t>(checked(parameters).transceiver.fifo_depth)),
      transceiver("transceiver", parameters.transceiver, carrier_power(parameters), fifo),
      gated_clock("gated_clock", parameters.control_unit.clock_frequency,
                  parameters.control_unit.clock_gating),
      control_unit("control_unit", parameters, fifo),
      adc("adc", parameters.adc),
      power_unit("power_unit", parameters.power) {
  wire_transceiver();
  wire_control_unit();
  wire_adc();
  wire_power_unit();
}

bool Sensor::idle() const {
  return transceiver.idle() && fifo.empty() && control_unit.asleep() && !awake.read();
}

void Sensor::wire_transceiver() {
  transceiver.powered(powered);
  transceiver.field_power(field_power);
  transceiver.carrier(carrier);
  transceiver.received_data(received_data);
  transceiver.answer_data(answer_data);
  transceiver.current(transceiver_current_);
}

void Sensor::wire_control_unit() {
  gated_clock.powered(powered);
  gated_clock.enable(awake);
  gated_clock.clock(clock);

  control_unit.clock(clock);
  control_unit.powered(powered);
  control_unit.carrier(carrier);
  control_unit.clock_enable(awake);
  control_unit.current(control_unit_current_);
  control_unit.led(led);
  control_unit.led_current(led_current_);
  control_unit.adc_start(adc_start);
  control_unit.adc_busy(adc_busy);
  control_unit.adc_code(adc_code);
  control_unit.transmitter(transceiver);
}

void Sensor::wire_adc() {
  adc.clock(clock);
  adc.powered(powered);
  adc.start(adc_start);
  adc.temperature(temperature);
  adc.busy(adc_busy);
  adc.code(adc_code);
  adc.current(adc_current_);
}

void Sensor::wire_power_unit() {
  power_unit.field_power(field_power);
  power_unit.control_unit_current(control_unit_current_);
  power_unit.transceiver_current(transceiver_current_);
  power_unit.adc_current(adc_current_);
  power_unit.led_current(led_current_);
  power_unit.powered(powered);
  power_unit.energy_intake(energy_intake);
  power_unit.energy_load(energy_load);
  power_unit.charge(charge);
  power_unit.voltage(voltage);
}

}  // namespace sensor
