#include "units/nfc_channel/model.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "units/nfc_channel/noise.h"

namespace nfc_channel {
namespace {

enum Stream : std::uint32_t { kDown = 0, kUp = 1 };

[[noreturn]] void out_of_range(const std::string& name, double value, const std::string& range) {
  std::ostringstream message;
  message << name << " is " << value << ": expected " << range;
  throw std::invalid_argument(message.str());
}

void require_positive(const std::string& name, double value) {
  if (!(value > 0.0 && std::isfinite(value))) out_of_range(name, value, "more than 0");
}

void require_not_negative(const std::string& name, double value) {
  if (!(value >= 0.0 && std::isfinite(value))) out_of_range(name, value, "0 or more");
}

void require_share(const std::string& name, double value) {
  if (!(value >= 0.0 && value <= 1.0)) out_of_range(name, value, "0 to 1");
}

void check(const std::string& name, const Coil& coil) {
  require_positive(name + ".radius", coil.radius);
  require_positive(name + ".turns", coil.turns);
  require_positive(name + ".wire_radius", coil.wire_radius);
  if (coil.wire_radius > 0.5 * coil.radius) {
    out_of_range(name + ".wire_radius", coil.wire_radius, "at most half the coil's radius");
  }
  require_not_negative(name + ".inductance", coil.inductance);
  require_positive(name + ".quality_factor", coil.quality_factor);
}

void check(const std::string& name, const Noise& noise) {
  require_not_negative(name + ".noise_temperature", noise.temperature);
  require_not_negative(name + ".interference", noise.interference);
}

const Parameters& checked(const Parameters& parameters) {
  check("reader_coil", parameters.reader_coil);
  check("tag_coil", parameters.tag_coil);
  require_share("tag.load_match", parameters.load_match);
  require_share("tag.modulation_depth", parameters.modulation_depth);
  require_positive("tag.power_limit", parameters.tag_power_limit);
  require_not_negative("tag.power_threshold", parameters.tag_power_threshold);
  require_not_negative("reader.sensitivity", parameters.reader_sensitivity);
  check("tag", parameters.tag_noise);
  check("reader", parameters.reader_noise);
  return parameters;
}

double bits_per_second(const nfc::Frame& frame) {
  return 1.0 / stride::to_seconds(nfc::bit_duration(frame.bit_rate));
}

}  // namespace

Channel::Channel(const Parameters& parameters) : parameters_(checked(parameters)) {}

void Channel::move(const Pose& reader_coil, const Pose& tag_coil, double carrier_power) {
  require_not_negative("carrier_power", carrier_power);
  const Parameters& p = parameters_;
  link_.distance = (tag_coil.position - reader_coil.position).norm();
  if (!std::isfinite(link_.distance)) {
    throw std::invalid_argument("the position of a coil is not finite");
  }
  link_.coupling = coupling_factor(p.reader_coil, reader_coil, p.tag_coil, tag_coil);

  const double gain = p.load_match * link_efficiency(link_.coupling, p.reader_coil.quality_factor,
                                                     p.tag_coil.quality_factor);
  link_.down.signal_power = carrier_power * gain;
  link_.tag_power = std::min(link_.down.signal_power, p.tag_power_limit);
  link_.down.heard = link_.tag_power > 0.0 && link_.tag_power >= p.tag_power_threshold;

  // the tag answers by reflecting a part of what it gets, which takes the same way back
  const double reflected = p.modulation_depth * p.modulation_depth * link_.down.signal_power;
  link_.up.signal_power = reflected * gain;
  link_.up.heard = link_.up.signal_power > 0.0 && link_.up.signal_power >= p.reader_sensitivity;
}

double Channel::snr_down(double bit_rate) const {
  return signal_to_noise(link_.down.signal_power, parameters_.tag_noise, bit_rate);
}

double Channel::snr_up(double bit_rate) const {
  return signal_to_noise(link_.up.signal_power, parameters_.reader_noise, bit_rate);
}

std::optional<nfc::Frame> Channel::to_tag(const nfc::Frame& frame) {
  const FrameNumber number{kDown, state_.frames_down++};
  if (!link_.down.heard) return std::nullopt;
  nfc::Frame heard = frame;
  const double errors = bit_error_probability(snr_down(bits_per_second(frame)));
  heard.bits = with_errors(frame.bits, errors, parameters_.seed, number);
  return heard;
}

std::optional<nfc::Frame> Channel::to_reader(const nfc::Frame& frame) {
  const FrameNumber number{kUp, state_.frames_up++};
  if (!link_.up.heard) return std::nullopt;
  nfc::Frame heard = frame;
  const double errors = bit_error_probability(snr_up(bits_per_second(frame)));
  heard.bits = with_errors(frame.bits, errors, parameters_.seed, number);
  return heard;
}

}  // namespace nfc_channel
