#include "units/nfc_channel/circuit.h"

#include <cmath>

namespace nfc_channel {
namespace {

using Complex = std::complex<double>;

constexpr double kOmega = kCarrierAngularFrequency;
constexpr Complex kJ{0.0, 1.0};

// What the tag's coil looks like from the chip: a current source with an inner admittance.
struct Source {
  Complex current;
  Complex admittance;
};

Source seen_from_chip(double mutual, Complex reader_impedance, Complex coil_impedance,
                      Complex source_voltage) {
  const Complex reactance = kJ * kOmega * mutual;
  const Complex impedance = coil_impedance - reactance * reactance / reader_impedance;
  return {reactance * source_voltage / (reader_impedance * impedance), 1.0 / impedance};
}

}  // namespace

ReaderAntenna::ReaderAntenna(const Coil& coil, double capacitance)
    : resistance(kOmega * inductance(coil) / coil.quality_factor),
      reactance(capacitance > 0.0 ? kOmega * inductance(coil) - 1.0 / (kOmega * capacitance) : 0.0),
      quality(0.5 * coil.quality_factor) {}

Circuit::Circuit(const ReaderAntenna& reader, const Coil& tag_coil, const TagChip& chip)
    : reader_(reader),
      tag_reactance_(kOmega * inductance(tag_coil)),
      tag_resistance_(tag_reactance_ / tag_coil.quality_factor),
      tag_susceptance_(chip.capacitance > 0.0 ? kOmega * chip.capacitance : 1.0 / tag_reactance_),
      chip_(chip) {}

Operation Circuit::solve(double mutual, Complex source_voltage, double limiter_conductance,
                         double conductance) const {
  const Complex reader_impedance{2.0 * reader_.resistance, reader_.reactance};
  const Source source =
      seen_from_chip(mutual, reader_impedance, {tag_resistance_, tag_reactance_}, source_voltage);
  const Complex chip{conductance + limiter_conductance, tag_susceptance_};
  Operation operation;
  operation.source_voltage = source_voltage;
  operation.limiter_conductance = limiter_conductance;
  operation.tag_voltage = source.current / (source.admittance + chip);
  operation.tag_current = chip * operation.tag_voltage;
  operation.reader_current =
      (source_voltage + kJ * kOmega * mutual * operation.tag_current) / reader_impedance;
  return operation;
}

Operation Circuit::operate(double mutual, double carrier_power, bool limited) const {
  const Complex source_voltage = std::sqrt(8.0 * reader_.resistance * carrier_power);
  const double load = 1.0 / chip_.load_resistance;
  const Operation free = solve(mutual, source_voltage, 0.0, load);
  if (!limited || std::abs(free.tag_voltage) <= chip_.voltage_limit) return free;

  // |I| = limit |Y + Gs|, solved for Gs
  const Complex reader_impedance{2.0 * reader_.resistance, reader_.reactance};
  const Source source =
      seen_from_chip(mutual, reader_impedance, {tag_resistance_, tag_reactance_}, source_voltage);
  const Complex rest = source.admittance + Complex{load, tag_susceptance_};
  const double needed = std::abs(source.current) / chip_.voltage_limit;
  const double shunt = std::sqrt((needed - rest.imag()) * (needed + rest.imag())) - rest.real();
  return solve(mutual, source_voltage, shunt, load);
}

Operation Circuit::modulate(double mutual, const Operation& unmodulated) const {
  const double conductance = 1.0 / chip_.load_resistance + 1.0 / chip_.modulation_resistance;
  return solve(mutual, unmodulated.source_voltage, unmodulated.limiter_conductance, conductance);
}

double Circuit::into_antenna(const Operation& operation) const {
  const Complex voltage = operation.source_voltage - reader_.resistance * operation.reader_current;
  return 0.5 * std::real(voltage * std::conj(operation.reader_current));
}

double Circuit::in_reader_coil(const Operation& operation) const {
  return 0.5 * std::norm(operation.reader_current) * reader_.resistance;
}

double Circuit::in_tag_coil(const Operation& operation) const {
  return 0.5 * std::norm(operation.tag_current) * tag_resistance_;
}

double Circuit::in_load(const Operation& operation) const {
  return 0.5 * std::norm(operation.tag_voltage) / chip_.load_resistance;
}

double Circuit::in_limiter(const Operation& operation) const {
  return 0.5 * std::norm(operation.tag_voltage) * operation.limiter_conductance;
}

double Circuit::tag_quality() const {
  return 1.0 / (tag_resistance_ / tag_reactance_ + tag_reactance_ / chip_.load_resistance);
}

}  // namespace nfc_channel
