#include "units/rf_channel/parameters.h"

#include <cmath>
#include <string>

#include "units/channel/check.h"
#include "units/channel/decibels.h"

namespace rf_channel {
namespace {

using channel::out_of_range;
using channel::require_not_negative;

void require_decibels(const std::string& name, double value, double least) {
  if (value >= least && value <= 100.0) return;
  out_of_range(name, value, std::to_string(static_cast<int>(least)) + " to 100 dB");
}

void check(const std::string& name, const Radio& radio) {
  require_decibels(name + ".antenna_gain", radio.antenna_gain, -100.0);
  require_decibels(name + ".noise_figure", radio.noise_figure, 0.0);
  require_not_negative(name + ".interference", radio.interference);
  require_not_negative(name + ".sensitivity", radio.sensitivity);
}

void check(const Ground& ground) {
  if (!std::isfinite(ground.height)) {
    out_of_range("ground.height", ground.height, "a finite number of metres");
  }
  if (!(ground.permittivity >= 1.0 && std::isfinite(ground.permittivity))) {
    out_of_range("ground.permittivity", ground.permittivity, "1 or more");
  }
  require_not_negative("ground.conductivity", ground.conductivity);
}

}  // namespace

void check(const Parameters& parameters) {
  check("reader", parameters.reader);
  channel::require_a_tag(parameters.tags.size());
  for (const TagParameters& tag : parameters.tags) {
    check(tag.name.prefix(), tag.radio);
    require_not_negative(tag.name.prefix() + ".transmit_power", tag.transmit_power);
  }
  if (!(parameters.frequency >= 1e8 && parameters.frequency <= 1e11)) {
    out_of_range("frequency", parameters.frequency, "1e8 to 1e11 Hz");
  }
  check(parameters.ground);
}

double noise_power(const Radio& radio, double bandwidth) {
  constexpr double kBoltzmann = 1.380649e-23;  // [J/K]
  constexpr double kRoomTemperature = 290.0;   // [K]
  return kBoltzmann * kRoomTemperature * bandwidth * channel::from_decibels(radio.noise_figure) +
         radio.interference;
}

}  // namespace rf_channel
