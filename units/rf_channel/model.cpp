#include "units/rf_channel/model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "units/channel/decibels.h"

namespace rf_channel {

using channel::Direction;
using channel::Signals;

namespace {

constexpr double kReceiverResistance = 50.0;  // [Ohm]

const Parameters& checked(const Parameters& parameters) {
  check(parameters);
  return parameters;
}

channel::Rules rules() {
  channel::Rules rules;
  rules.overlap = channel::Overlap::Interfere;
  return rules;
}

double ratio_of(double signal, double noise) {
  if (!(signal > 0.0)) return 0.0;
  return noise > 0.0 ? signal / noise : std::numeric_limits<double>::infinity();
}

double gain_of(const Radio& first, const Radio& second) {
  return channel::from_decibels(first.antenna_gain + second.antenna_gain);
}

// P = S lambda^2 G / (4 pi) for the power density S = H^2 Z_0 (Balanis, "Antenna Theory", 4th ed.,
// section 2.15)
double field_strength(double received, const Radio& receiver, double frequency) {
  const double wavelength = kSpeedOfLight / frequency;
  const double gain = channel::from_decibels(receiver.antenna_gain);
  const double density = received * 4.0 * M_PI / (wavelength * wavelength * gain);
  return std::sqrt(density / kVacuumImpedance);
}

}  // namespace

Channel::Channel(const Parameters& parameters)
    : Model(channel::names_of(parameters.tags), rules(), parameters.seed),
      parameters_(checked(parameters)) {
  const double bandwidth = packet_format(parameters.modulation).bandwidth;
  reader_noise_ = noise_power(parameters.reader, bandwidth);
  for (const TagParameters& tag : parameters.tags) {
    tag_noises_.push_back(noise_power(tag.radio, bandwidth));
  }
}

void Channel::move_tag(std::size_t index, const Pose& reader, const Pose& tag, Link& link) {
  const Radio& radio = parameters_.tags[index].radio;
  link.distance = (tag.position - reader.position).norm();
  link.gain = path_gain(reader, tag,
                        {parameters_.antenna, gain_of(parameters_.reader, radio),
                         parameters_.ground, parameters_.frequency});
  link.coupling = std::sqrt(link.gain);
  link.signals = signals(index, carrier_power());
  link.field_strength = field_strength(link.signals.down, radio, parameters_.frequency);
  link.tag_voltage = std::sqrt(2.0 * kReceiverResistance * link.signals.down);
  link.snr_down = ratio_of(link.signals.down, tag_noises_[index]);
  link.snr_up = ratio_of(link.signals.up, reader_noise_);
  link.bit_error_rate_down =
      rf_channel::bit_error_probability(parameters_.modulation, link.snr_down);
  link.bit_error_rate_up = rf_channel::bit_error_probability(parameters_.modulation, link.snr_up);
}

// The way back is as good as the way there.
Signals Channel::signals(std::size_t tag, double carrier_power) const {
  if (carrier_power == 0.0) return {};
  const double gain = link(tag).gain;
  return {carrier_power * gain, parameters_.tags[tag].transmit_power * gain};
}

double Channel::least_signal(Direction direction, std::size_t tag) const {
  return direction == Direction::Up ? parameters_.reader.sensitivity
                                    : parameters_.tags[tag].radio.sensitivity;
}

double Channel::bit_error_probability(Direction direction, std::size_t tag, std::uint32_t,
                                      double signal, double others) const {
  const double noise = direction == Direction::Up ? reader_noise_ : tag_noises_[tag];
  return rf_channel::bit_error_probability(parameters_.modulation,
                                           ratio_of(signal, noise + others));
}

channel::Transit Channel::transit(const nfc::Frame& frame, std::size_t tag,
                                  stride::Time free) const {
  const PacketFormat& format = packet_format(parameters_.modulation);
  const std::size_t octets = (frame.bits.size() + 7) / 8;
  if (octets > format.most_octets) {
    throw std::invalid_argument("a frame of " + std::to_string(frame.bits.size()) +
                                " bits does not fit into a packet: expected " +
                                std::to_string(8 * format.most_octets) + " bits at most");
  }
  const stride::Time handed_over = frame.start + nfc::air_time(frame);
  channel::Transit transit;
  transit.is_stored = true;
  transit.propagation = stride::duration_from_seconds(link(tag).distance / kSpeedOfLight);
  transit.begin = std::max(handed_over, free) + transit.propagation;
  transit.header = format.header;
  transit.header_bits = format.header_bits;
  transit.symbol = format.symbol;
  transit.bits_per_symbol = format.bits_per_symbol;
  const stride::Time last = transit.end_of_bits(frame.bits.size());
  const stride::Time end = transit.end_of_bits(8 * octets);
  transit.trailer = end - last;
  transit.delay = end - handed_over;
  return transit;
}

}  // namespace rf_channel
