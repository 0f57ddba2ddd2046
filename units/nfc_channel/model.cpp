#include "units/nfc_channel/model.h"

#include <algorithm>
#include <cmath>

#include "units/channel/decibels.h"

namespace nfc_channel {

using channel::Direction;
using channel::Signals;

namespace {

constexpr std::array<std::uint32_t, 4> kBitRates = {106, 212, 424, 848};

std::size_t index_of(std::uint32_t bit_rate) {
  return static_cast<std::size_t>(std::find(kBitRates.begin(), kBitRates.end(), bit_rate) -
                                  kBitRates.begin());
}

const Parameters& checked(const Parameters& parameters) {
  check(parameters);
  return parameters;
}

/// What a tag's circuit, uncoupled, makes available with this amplitude [W].
double signal_of(const Circuit& circuit, double voltage) {
  return voltage * voltage / (8.0 * circuit.tag_resistance());
}

channel::Rules rules(const Parameters& parameters) {
  channel::Rules rules;
  rules.capture_ratio = channel::from_decibels(parameters.reader.capture_ratio);
  return rules;
}

}  // namespace

Channel::Channel(const Parameters& parameters)
    : Model(channel::names_of(parameters.tags), rules(parameters), parameters.seed),
      parameters_(checked(parameters)),
      reader_noise_density_(noise_density(parameters.reader.noise)) {
  const ReaderAntenna reader(parameters.reader.coil, parameters.reader.capacitance);
  for (const TagParameters& tag : parameters.tags) {
    const Circuit circuit(reader, tag.coil, tag.chip);
    Tag added{tag,
              circuit,
              {},
              {},
              nfc_channel::noise_density(tag.noise),
              signal_of(circuit, tag.demodulator_voltage + tag.rectifier_drop)};
    for (std::size_t i = 0; i < kBitRates.size(); ++i) {
      added.down[i] = down_signal(kBitRates[i], reader.quality, circuit.tag_quality());
      added.up[i] = up_signal(kBitRates[i], reader.quality, circuit.modulated_quality());
    }
    tags_.push_back(added);
  }
}

void Channel::move_tag(std::size_t index, const Pose& reader_coil, const Pose& tag_coil,
                       Link& link) {
  const Tag& tag = tags_[index];
  const Coil& coil = tag.parameters.coil;
  link.distance = (tag_coil.position - reader_coil.position).norm();
  link.mutual = mutual_inductance(parameters_.reader.coil, reader_coil, coil, tag_coil);
  link.coupling = coupling_factor(parameters_.reader.coil, coil, link.mutual);

  const Operation operation = tag.circuit.operate(link.mutual, carrier_power());
  const double flux = std::abs(link.mutual * operation.reader_current) / coil.turns;
  link.field_strength =
      flux / (kVacuumPermeability * M_PI * coil.radius * coil.radius) / std::sqrt(2.0);
  link.field_reach = field_reach(parameters_.reader.coil,
                                 std::abs(operation.reader_current) / std::sqrt(2.0), kLeastField);
  const Source source = tag.circuit.source(link.mutual, carrier_power());
  link.tag_voltage = source.voltage;
  link.tag_power = source.available_power;

  link.signals = signals_at(index, carrier_power());
  const std::size_t rate = index_of(parameters_.bit_rate);
  link.snr_down = signal_to_noise(link.signals.down, tag.down[rate], tag.noise_density);
  link.snr_up = signal_to_noise(link.signals.up, tag.up[rate], reader_noise_density_);
  link.bit_error_rate_down =
      nfc_channel::bit_error_probability(link.snr_down, tag.down[rate].coherent);
  link.bit_error_rate_up = nfc_channel::bit_error_probability(link.snr_up, tag.up[rate].coherent);
}

Signals Channel::signals(std::size_t tag, double carrier_power) const {
  return carrier_power == this->carrier_power() ? link(tag).signals
                                                : signals_at(tag, carrier_power);
}

Signals Channel::signals_at(std::size_t index, double carrier_power) const {
  const Circuit& circuit = tags_[index].circuit;
  const double mutual = link(index).mutual;
  return {signal_of(circuit, circuit.source(mutual, carrier_power).voltage),
          sideband_power(circuit, mutual, circuit.operate(mutual, carrier_power))};
}

double Channel::least_signal(Direction direction, std::size_t tag) const {
  return direction == Direction::Up ? parameters_.reader.sensitivity : tags_[tag].least_signal;
}

double Channel::bit_error_probability(Direction direction, std::size_t index,
                                      std::uint32_t bit_rate, double signal, double others) const {
  const Tag& tag = tags_[index];
  const bool up = direction == Direction::Up;
  const BitSignal& bit = (up ? tag.up : tag.down)[index_of(bit_rate)];
  const double noise =
      (up ? reader_noise_density_ : tag.noise_density) + others / kInterferenceBandwidth;
  return nfc_channel::bit_error_probability(signal_to_noise(signal, bit, noise), bit.coherent);
}

}  // namespace nfc_channel
