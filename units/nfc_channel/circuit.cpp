#include "units/nfc_channel/circuit.h"

#include <cmath>

namespace nfc_channel {
namespace {

using Complex = std::complex<double>;

constexpr double kOmega = kCarrierAngularFrequency;
constexpr Complex kJ{0.0, 1.0};

// What the tag's coil looks like from the chip: a current source with an inner admittance.
struct CurrentSource {
  Complex current;
  Complex admittance;
};

CurrentSource seen_from_chip(double mutual, Complex reader_impedance, Complex coil_impedance,
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

Operation Circuit::solve(double mutual, Complex source_voltage, double chip_conductance,
                         double modulation_conductance) const {
  const Complex reader_impedance{2.0 * reader_.resistance, reader_.reactance};
  const CurrentSource source =
      seen_from_chip(mutual, reader_impedance, {tag_resistance_, tag_reactance_}, source_voltage);
  const Complex chip{chip_conductance + modulation_conductance, tag_susceptance_};
  Operation operation;
  operation.source_voltage = source_voltage;
  operation.chip_conductance = chip_conductance;
  operation.tag_voltage = source.current / (source.admittance + chip);
  operation.tag_current = chip * operation.tag_voltage;
  operation.reader_current =
      (source_voltage + kJ * kOmega * mutual * operation.tag_current) / reader_impedance;
  return operation;
}

Circuit::Norton Circuit::antenna(double mutual, double carrier_power) const {
  const Complex reader_impedance{2.0 * reader_.resistance, reader_.reactance};
  const CurrentSource source = seen_from_chip(
      mutual, reader_impedance, {tag_resistance_, tag_reactance_}, source_voltage(carrier_power));
  return {std::abs(source.current), source.admittance + Complex{0.0, tag_susceptance_}};
}

double Circuit::source_voltage(double carrier_power) const {
  return std::sqrt(8.0 * reader_.resistance * carrier_power);
}

Source Circuit::source(double mutual, double carrier_power) const {
  const Norton antenna = this->antenna(mutual, carrier_power);
  const double admittance = std::abs(antenna.admittance);
  return {antenna.current / admittance,
          antenna.current * antenna.current / (4.0 * (admittance + antenna.admittance.real()))};
}

Operation Circuit::operate(double mutual, double carrier_power) const {
  const Norton antenna = this->antenna(mutual, carrier_power);
  const Complex rest = antenna.admittance;
  const double needed = antenna.current / chip_.voltage_limit;
  double conductance = 0.0;
  if (needed > std::abs(rest)) {  // |I| = limit |Y + Gs|, solved for Gs
    conductance = std::sqrt((needed - rest.imag()) * (needed + rest.imag())) - rest.real();
  }
  return solve(mutual, source_voltage(carrier_power), conductance, 0.0);
}

Operation Circuit::modulate(double mutual, const Operation& unmodulated) const {
  return solve(mutual, unmodulated.source_voltage, unmodulated.chip_conductance,
               1.0 / chip_.modulation_resistance);
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

double Circuit::in_chip(const Operation& operation) const {
  return 0.5 * std::norm(operation.tag_voltage) * operation.chip_conductance;
}

double Circuit::tag_resistance() const {
  return tag_resistance_ + tag_reactance_ * tag_reactance_ / tag_resistance_;
}

double Circuit::tag_quality() const { return tag_reactance_ / tag_resistance_; }

double Circuit::modulated_quality() const {
  return 1.0 / (1.0 / tag_quality() + 0.5 * tag_reactance_ / chip_.modulation_resistance);
}

}  // namespace nfc_channel
