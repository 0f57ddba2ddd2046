#include "units/nfc_channel/parameters.h"

#include <string>

#include "units/channel/check.h"

namespace nfc_channel {
namespace {

using channel::out_of_range;
using channel::require_not_negative;
using channel::require_positive;

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

void check(const ReaderParameters& reader) {
  check("reader_coil", reader.coil);
  require_not_negative("reader.capacitance", reader.capacitance);
  check("reader", reader.noise);
  require_not_negative("reader.sensitivity", reader.sensitivity);
  require_not_negative("reader.capture_ratio", reader.capture_ratio);
}

void check(const TagParameters& tag) {
  const std::string name = tag.name.prefix();
  check(tag.name.coil(), tag.coil);
  require_not_negative(name + ".capacitance", tag.chip.capacitance);
  require_positive(name + ".voltage_limit", tag.chip.voltage_limit);
  require_positive(name + ".modulation_resistance", tag.chip.modulation_resistance);
  require_not_negative(name + ".rectifier_drop", tag.rectifier_drop);
  require_not_negative(name + ".demodulator_voltage", tag.demodulator_voltage);
  check(name, tag.noise);
}

}  // namespace

void check(const Parameters& parameters) {
  check(parameters.reader);
  channel::require_a_tag(parameters.tags.size());
  for (const TagParameters& tag : parameters.tags) check(tag);
  const std::uint32_t rate = parameters.bit_rate;
  if (rate != 106 && rate != 212 && rate != 424 && rate != 848) {
    out_of_range("bit_rate", rate, "106, 212, 424 or 848 kbit/s");
  }
}

}  // namespace nfc_channel
