#include "units/sensor/supply.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sensor {

using Mode = Flow::Mode;

EnergyBooks& EnergyBooks::operator+=(const EnergyBooks& other) {
  field += other.field;
  rectifier += other.rectifier;
  limiter += other.limiter;
  charger += other.charger;
  series_resistance += other.series_resistance;
  leakage += other.leakage;
  regulator += other.regulator;
  for (std::size_t i = 0; i < kParts; ++i) parts[i] += other.parts[i];
  return *this;
}

double EnergyBooks::all_but_field_and_stored() const {
  return std::accumulate(parts.begin(), parts.end(),
                         rectifier + limiter + charger + series_resistance + leakage + regulator);
}

Flow Supply::flow(double field_power, const Currents& parts, double voltage) const {
  Flow flow;
  flow.field_power = field_power;
  flow.source = p_.rectifier_efficiency * field_power / p_.maximum_voltage;
  flow.parts = parts;
  flow.load = std::accumulate(parts.begin(), parts.end(), 0.0);
  flow.current = std::min(flow.source - flow.load, p_.charging_current);
  if (flow.source <= flow.load) return flow;
  flow.mode = voltage > knee(flow) ? Mode::ConstantVoltage : Mode::ConstantCurrent;
  return flow;
}

double Supply::knee(const Flow& flow) const {
  return p_.maximum_voltage - flow.current * p_.series_resistance;
}

Relaxation Supply::capacitor(const Flow& flow) const {
  const double leakage_rate = 1 / (p_.leakage_resistance * p_.capacitance);
  if (flow.mode != Mode::ConstantVoltage) return {flow.current / p_.capacitance, leakage_rate};
  const double charging_rate = 1 / (p_.series_resistance * p_.capacitance);
  return {p_.maximum_voltage * charging_rate, charging_rate + leakage_rate};
}

double Supply::current(const Flow& flow, double voltage) const {
  if (flow.mode != Mode::ConstantVoltage) return flow.current;
  return (p_.maximum_voltage - voltage) / p_.series_resistance;
}

double Supply::terminal(const Flow& flow, double voltage) const {
  if (flow.mode == Mode::ConstantVoltage) return p_.maximum_voltage;
  return voltage + flow.current * p_.series_resistance;
}

double Supply::rail(const Flow& flow, double voltage) const {
  return flow.mode == Mode::FromCapacitor ? terminal(flow, voltage) : p_.maximum_voltage;
}

double Supply::intake(const Flow& flow, double voltage) const {
  return rail(flow, voltage) * (flow.load + current(flow, voltage));
}

double Supply::load(const Flow& flow, double voltage) const {
  return rail(flow, voltage) * flow.load;
}

double Supply::voltage_for_terminal(const Flow& flow, double terminal) const {
  return terminal - flow.current * p_.series_resistance;
}

EnergyBooks Supply::books(const Flow& flow, double voltage, double seconds) const {
  const Relaxation law = capacitor(flow);
  EnergyBooks books;
  books.leakage = law.integral_of_square(voltage, seconds) / p_.leakage_resistance;
  for (std::size_t i = 0; i < kParts; ++i) {
    books.parts[i] = flow.parts[i] * p_.supply_voltage * seconds;
  }
  double rail = p_.maximum_voltage * seconds;  // integrated
  if (flow.mode == Mode::FromCapacitor) {
    const double drop = flow.current * p_.series_resistance;
    rail = law.integral(voltage, seconds) + drop * seconds;
    books.series_resistance = drop * flow.current * seconds;
  } else {
    add_charging(books, flow, voltage, seconds);
  }
  books.field = flow.field_power / p_.maximum_voltage * rail;
  books.rectifier = (1 - p_.rectifier_efficiency) * books.field;
  books.regulator = flow.load * (rail - p_.supply_voltage * seconds);
  return books;
}

// The integrals are over the gap between the maximum voltage and the capacitance's, or the
// terminal's, which follows the same kind of law.
void Supply::add_charging(EnergyBooks& books, const Flow& flow, double voltage,
                          double seconds) const {
  const double left = flow.source - flow.load;
  const Relaxation law = capacitor(flow);
  if (flow.mode == Mode::ConstantCurrent) {
    const double drop = flow.current * p_.series_resistance;
    const double highest = p_.maximum_voltage - drop;
    const Relaxation gap{law.rate * highest - law.drift, law.rate};
    books.charger = flow.current * gap.integral(highest - voltage, seconds);
    books.series_resistance = drop * flow.current * seconds;
    books.limiter = p_.maximum_voltage * (left - flow.current) * seconds;
    return;
  }
  const Relaxation gap{p_.maximum_voltage / (p_.leakage_resistance * p_.capacitance), law.rate};
  const double start = p_.maximum_voltage - voltage;
  const double charge = gap.integral(start, seconds) / p_.series_resistance;
  books.series_resistance = gap.integral_of_square(start, seconds) / p_.series_resistance;
  books.limiter = p_.maximum_voltage * (left * seconds - charge);
}

PowerReadings Supply::rates(const Flow& flow, double voltage) const {
  const double slope = capacitor(flow).slope(voltage);
  PowerReadings rates;
  rates.charge = p_.capacitance * slope;
  rates.stored = rates.charge * voltage;
  rates.books = powers(flow, voltage);
  switch (flow.mode) {
    case Mode::FromCapacitor:
      rates.terminal = rates.rail = slope;
      rates.intake = slope * (flow.load + flow.current);
      rates.load = slope * flow.load;
      break;
    case Mode::ConstantCurrent:
      rates.terminal = slope;
      break;
    case Mode::ConstantVoltage:
      rates.intake = -p_.maximum_voltage * slope / p_.series_resistance;
      break;
  }
  return rates;
}

EnergyBooks Supply::powers(const Flow& flow, double voltage) const {
  const double into = current(flow, voltage);
  const double left = flow.source - flow.load;
  const double on_rail = rail(flow, voltage);
  EnergyBooks powers;
  powers.field = flow.field_power / p_.maximum_voltage * on_rail;
  powers.rectifier = (1 - p_.rectifier_efficiency) * powers.field;
  powers.series_resistance = into * into * p_.series_resistance;
  powers.leakage = voltage * voltage / p_.leakage_resistance;
  powers.regulator = flow.load * (on_rail - p_.supply_voltage);
  for (std::size_t i = 0; i < kParts; ++i) powers.parts[i] = flow.parts[i] * p_.supply_voltage;
  if (flow.mode != Mode::FromCapacitor) {
    powers.charger = into * (p_.maximum_voltage - terminal(flow, voltage));
    powers.limiter = p_.maximum_voltage * (left - into);
  }
  return powers;
}

PowerReadings Supply::curvatures(const Flow& flow, double voltage) const {
  const Relaxation law = capacitor(flow);
  const double slope = std::abs(law.slope(voltage));
  const double bend = law.rate * slope;
  const double highest = std::max(voltage, p_.maximum_voltage);
  PowerReadings bounds;
  bounds.charge = p_.capacitance * bend;
  bounds.stored = p_.capacitance * (slope * slope + highest * bend);
  bounds.books.leakage = 2 * highest * slope / p_.leakage_resistance;
  switch (flow.mode) {
    case Mode::FromCapacitor:
      bounds.terminal = bounds.rail = bend;
      bounds.intake = bend * std::abs(flow.load + flow.current);
      bounds.load = bend * flow.load;
      bounds.books.field = flow.field_power / p_.maximum_voltage * slope;
      bounds.books.rectifier = (1 - p_.rectifier_efficiency) * bounds.books.field;
      bounds.books.regulator = flow.load * slope;
      break;
    case Mode::ConstantCurrent:
      bounds.terminal = bend;
      bounds.books.charger = flow.current * slope;
      break;
    case Mode::ConstantVoltage:
      bounds.intake = p_.maximum_voltage * bend / p_.series_resistance;
      bounds.books.series_resistance = 2 * flow.current * slope;
      bounds.books.limiter = p_.maximum_voltage * slope / p_.series_resistance;
      break;
  }
  return bounds;
}

}  // namespace sensor
