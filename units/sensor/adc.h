// The analogue-to-digital converter, with its temperature sensor.
#ifndef STRIDE_UNITS_SENSOR_ADC_H
#define STRIDE_UNITS_SENSOR_ADC_H

#include <cstdint>
#include <systemc>

#include "units/sensor/parameters.h"

namespace sensor {

/// Twelve bits over [minimum, maximum], nearest code, saturating; off by the offset error.
std::int32_t to_code(const AdcParameters& parameters, double temperature);

/// The calibrated result: the temperature of a code in 1/100 degC, rounded.
std::int16_t to_centidegrees(const AdcParameters& parameters, std::int32_t code);

/// A conversion begins at the rising clock edge that finds `start` set: the temperature is sampled
/// there, and the code is ready `conversion_cycles` edges later.
class Adc : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clock{"clock"};
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_in<bool> start{"start"};
  sc_core::sc_in<double> temperature{"temperature"};  ///< straight from the environment [degC]
  sc_core::sc_out<bool> busy{"busy"};
  sc_core::sc_out<std::int32_t> code{"code"};  ///< of the last conversion since power-on
  sc_core::sc_out<double> current{"current"};  ///< [A]

  Adc(sc_core::sc_module_name name, const AdcParameters& parameters);

 private:
  void run();
  void reset();
  void on_clock();

  AdcParameters parameters_;
  std::int32_t sample_ = 0;
  std::int32_t remaining_ = 0;
};

}  // namespace sensor

#endif
