#include "units/sensor/adc.h"

#include <algorithm>
#include <cmath>

namespace sensor {
namespace {

constexpr std::int32_t kMaximumCode = 4095;

}  // namespace

std::int32_t to_code(const AdcParameters& parameters, double temperature) {
  const double share = (temperature + parameters.offset_error - parameters.minimum) /
                       (parameters.maximum - parameters.minimum);
  return static_cast<std::int32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMaximumCode));
}

std::int16_t to_centidegrees(const AdcParameters& parameters, std::int32_t code) {
  const double step = (parameters.maximum - parameters.minimum) / kMaximumCode;
  return static_cast<std::int16_t>(std::lround(100 * (parameters.minimum + step * code)));
}

Adc::Adc(sc_core::sc_module_name name, const AdcParameters& parameters)
    : sc_module(name), parameters_(parameters) {
  SC_HAS_PROCESS(Adc);
  SC_METHOD(run);
  sensitive << clock.pos() << powered;
}

void Adc::run() {
  if (!powered.read()) return reset();
  if (clock.posedge()) on_clock();
}

void Adc::reset() {
  remaining_ = 0;
  busy.write(false);
  code.write(0);
  current.write(0);
}

void Adc::on_clock() {
  if (remaining_ == 0) {
    if (!start.read()) return;
    sample_ = to_code(parameters_, temperature.read());
    remaining_ = parameters_.conversion_cycles;
    busy.write(true);
    current.write(parameters_.current);
  } else if (--remaining_ == 0) {
    code.write(sample_);
    busy.write(false);
    current.write(0);
  }
}

}  // namespace sensor
