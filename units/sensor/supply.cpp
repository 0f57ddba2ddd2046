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

Source Supply::source(double field_power) const {
  const double amplitude = std::sqrt(8 * p_.antenna_resistance * field_power);
  return {std::max(0.0, amplitude - p_.rectifier_drop), 2 * p_.antenna_resistance};
}

double Supply::field_power_for(double rectified) const {
  if (rectified <= 0) return 0;
  const double amplitude = rectified + p_.rectifier_drop;
  return amplitude * amplitude / (8 * p_.antenna_resistance);
}

Flow Supply::flow(double field_power, const Currents& parts, double voltage) const {
  Flow flow;
  flow.source = source(field_power);
  flow.parts = parts;
  flow.load = std::accumulate(parts.begin(), parts.end(), 0.0);
  flow.offer = flow.source.current_at(p_.maximum_voltage);
  flow.floating = flow.source.voltage - flow.source.resistance * flow.load;
  if (flow.offer > flow.load) {
    flow.current = std::min(flow.offer - flow.load, p_.charging_current);
    flow.mode = Mode::ConstantCurrent;
    if (voltage > *knee(flow)) flow.mode = Mode::ConstantVoltage;
    return flow;
  }
  flow.current = -flow.load;
  if (flow.floating >= voltage) {
    flow.mode = Mode::FromField;
  } else if (flow.source.voltage > terminal(flow, voltage)) {
    flow.mode = Mode::FromBoth;
  }
  return flow;
}

std::optional<double> Supply::knee(const Flow& flow) const {
  switch (flow.mode) {
    case Mode::FromCapacitor:
      if (flow.source.voltage <= 0) return std::nullopt;
      return flow.source.voltage + flow.load * p_.series_resistance;
    case Mode::FromBoth:
      return flow.floating;
    case Mode::FromField:
      return std::nullopt;
    case Mode::ConstantCurrent:
    case Mode::ConstantVoltage:
      break;
  }
  return p_.maximum_voltage - flow.current * p_.series_resistance;
}

Mode Supply::after_knee(Mode mode) {
  switch (mode) {
    case Mode::FromCapacitor:
      return Mode::FromBoth;
    case Mode::FromBoth:
    case Mode::FromField:
      return Mode::FromField;
    case Mode::ConstantCurrent:
      return Mode::ConstantVoltage;
    case Mode::ConstantVoltage:
      break;
  }
  return Mode::ConstantCurrent;
}

Relaxation Supply::capacitor(const Flow& flow) const {
  switch (flow.mode) {
    case Mode::FromCapacitor:
    case Mode::ConstantCurrent:
      return {flow.current / p_.capacitance, leakage_rate()};
    case Mode::FromField:
      return {0, leakage_rate()};
    case Mode::FromBoth: {
      const double rate = 1 / (loop_resistance(flow) * p_.capacitance);
      return {flow.floating * rate, rate + leakage_rate()};
    }
    case Mode::ConstantVoltage:
      break;
  }
  const double rate = 1 / (p_.series_resistance * p_.capacitance);
  return {p_.maximum_voltage * rate, rate + leakage_rate()};
}

double Supply::current(const Flow& flow, double voltage) const {
  switch (flow.mode) {
    case Mode::FromCapacitor:
    case Mode::ConstantCurrent:
      return flow.current;
    case Mode::FromBoth:
      return (flow.floating - voltage) / loop_resistance(flow);
    case Mode::FromField:
      return 0;
    case Mode::ConstantVoltage:
      break;
  }
  return (p_.maximum_voltage - voltage) / p_.series_resistance;
}

double Supply::terminal(const Flow& flow, double voltage) const {
  if (flow.mode == Mode::ConstantVoltage) return p_.maximum_voltage;
  return voltage + current(flow, voltage) * p_.series_resistance;
}

double Supply::rail(const Flow& flow, double voltage) const {
  if (flow.mode == Mode::FromField) return flow.floating;
  return flow.is_charging() ? p_.maximum_voltage : terminal(flow, voltage);
}

double Supply::rectified(const Flow& flow, double voltage) const {
  if (flow.mode == Mode::FromCapacitor) return 0;
  return flow.is_charging() ? flow.offer : flow.load + current(flow, voltage);
}

double Supply::drawn(const Flow& flow, double voltage) const {
  return (rail(flow, voltage) + p_.rectifier_drop) * rectified(flow, voltage);
}

double Supply::intake(const Flow& flow, double voltage) const {
  return rail(flow, voltage) * (flow.load + current(flow, voltage));
}

double Supply::load(const Flow& flow, double voltage) const {
  return rail(flow, voltage) * flow.load;
}

double Supply::voltage_for_terminal(const Flow& flow, double terminal) const {
  if (flow.mode == Mode::FromField) return terminal;
  if (flow.mode != Mode::FromBoth) return terminal - flow.current * p_.series_resistance;
  return (terminal * loop_resistance(flow) - flow.floating * p_.series_resistance) /
         flow.source.resistance;
}

EnergyBooks Supply::books(const Flow& flow, double voltage, double seconds) const {
  EnergyBooks books;
  books.leakage = capacitor(flow).integral_of_square(voltage, seconds) / p_.leakage_resistance;
  for (std::size_t i = 0; i < kParts; ++i) {
    books.parts[i] = flow.parts[i] * p_.supply_voltage * seconds;
  }
  if (flow.is_charging()) {
    add_charging(books, flow, voltage, seconds);
  } else if (flow.mode == Mode::FromBoth) {
    add_sharing(books, flow, voltage, seconds);
  } else {
    add_feeding(books, flow, voltage, seconds);
  }
  return books;
}

// The capacitor alone, or the field alone.
void Supply::add_feeding(EnergyBooks& books, const Flow& flow, double voltage,
                         double seconds) const {
  double rail = flow.floating * seconds;  // integrated
  if (flow.mode == Mode::FromCapacitor) {
    const double drop = flow.current * p_.series_resistance;
    rail = capacitor(flow).integral(voltage, seconds) + drop * seconds;
    books.series_resistance = drop * flow.current * seconds;
  } else {
    books.rectifier = p_.rectifier_drop * flow.load * seconds;
    books.field = flow.load * rail + books.rectifier;
  }
  books.regulator = flow.load * (rail - p_.supply_voltage * seconds);
}

// The capacitor's current is a multiple of the gap between the capacitance's voltage and the
// floating one, the rectified one of the gap between the rail and the source's voltage. Both gaps
// follow laws of the same kind, and neither loses digits where it is small.
void Supply::add_sharing(EnergyBooks& books, const Flow& flow, double voltage,
                         double seconds) const {
  const double loop = loop_resistance(flow);
  const double inner = flow.source.resistance;
  const double rate = capacitor(flow).rate;
  const Relaxation above{-flow.floating * leakage_rate(), rate};
  const double square = above.integral_of_square(voltage - flow.floating, seconds) / loop / loop;

  const double highest = flow.source.voltage + p_.series_resistance * flow.load;
  const Relaxation below{inner / loop * (flow.load / p_.capacitance + leakage_rate() * highest),
                         rate};
  const double start = flow.source.voltage - rail(flow, voltage);
  const double gap = below.integral(start, seconds);
  const double squared_gap = below.integral_of_square(start, seconds);
  const double on_rail = flow.source.voltage * seconds - gap;  // integrated
  books.series_resistance = p_.series_resistance * square;
  books.rectifier = p_.rectifier_drop * gap / inner;
  books.regulator = flow.load * (on_rail - p_.supply_voltage * seconds);
  books.field = (flow.source.voltage * gap - squared_gap) / inner + books.rectifier;
}

// The integrals are over the gap between the maximum voltage and the capacitance's, or the
// terminal's, which follows the same kind of law.
void Supply::add_charging(EnergyBooks& books, const Flow& flow, double voltage,
                          double seconds) const {
  const double left = flow.offer - flow.load;
  books.rectifier = p_.rectifier_drop * flow.offer * seconds;
  books.field = p_.maximum_voltage * flow.offer * seconds + books.rectifier;
  books.regulator = flow.load * (p_.maximum_voltage - p_.supply_voltage) * seconds;
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
  const Relaxation gap{p_.maximum_voltage * leakage_rate(), law.rate};
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
      rates.load = slope * flow.load;
      break;
    case Mode::FromBoth: {
      const double on_rail = rail(flow, voltage);
      rates.terminal = rates.rail = slope * flow.source.resistance / loop_resistance(flow);
      const double lost = rates.rail / flow.source.resistance;  // of the rectified current
      rates.load = rates.rail * flow.load;
      rates.intake = rates.rail * rectified(flow, voltage) - on_rail * lost;
      rates.drawn = rates.intake - p_.rectifier_drop * lost;
      break;
    }
    case Mode::FromField:
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
  const double on_rail = rail(flow, voltage);
  EnergyBooks powers;
  powers.rectifier = p_.rectifier_drop * rectified(flow, voltage);
  powers.field = drawn(flow, voltage);
  powers.series_resistance = into * into * p_.series_resistance;
  powers.leakage = voltage * voltage / p_.leakage_resistance;
  powers.regulator = flow.load * (on_rail - p_.supply_voltage);
  for (std::size_t i = 0; i < kParts; ++i) powers.parts[i] = flow.parts[i] * p_.supply_voltage;
  if (flow.is_charging()) {
    powers.charger = into * (p_.maximum_voltage - terminal(flow, voltage));
    powers.limiter = p_.maximum_voltage * (flow.offer - flow.load - into);
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
      bounds.load = bend * flow.load;
      bounds.books.regulator = flow.load * slope;
      break;
    case Mode::FromBoth:
      add_sharing_bounds(bounds, flow, voltage);
      break;
    case Mode::FromField:
      bounds.terminal = bend;
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

// The rail falls from what it is now, and the rectified current rises to the load's at most.
void Supply::add_sharing_bounds(PowerReadings& bounds, const Flow& flow, double voltage) const {
  const Relaxation law = capacitor(flow);
  const double share = flow.source.resistance / loop_resistance(flow);
  const double slope = share * std::abs(law.slope(voltage));  // of the rail
  const double bend = law.rate * slope;
  const double gain = slope / flow.source.resistance;  // of the rectified current
  const double on_rail = rail(flow, voltage);
  const double most = std::max(flow.load, rectified(flow, voltage));
  const double feed = on_rail / flow.source.resistance;
  bounds.terminal = bounds.rail = bend;
  bounds.load = bend * flow.load;
  bounds.intake = bend * (most + feed) + 2 * slope * gain;
  bounds.drawn = bounds.intake + p_.rectifier_drop * bend / flow.source.resistance;
  bounds.books.regulator = flow.load * slope;
  bounds.books.rectifier = p_.rectifier_drop * gain;
  bounds.books.field = slope * (most + feed) + bounds.books.rectifier;
  bounds.books.series_resistance =
      2 * p_.series_resistance * std::abs(current(flow, voltage)) * gain;
}

}  // namespace sensor
