#include "units/sensor/parameters.h"

#include <sstream>
#include <stdexcept>

namespace sensor {
namespace {

void check_range(const ParameterInfo& info, double value) {
  if (value >= info.minimum && value <= info.maximum) return;
  std::ostringstream message;
  message << info.name << " = " << value << ": expected " << info.minimum << " to " << info.maximum
          << " " << info.unit;
  throw std::invalid_argument(message.str());
}

void check_order(const char* low_name, double low, const char* high_name, double high) {
  if (low < high) return;
  std::ostringstream message;
  message << low_name << " = " << low << " must be less than " << high_name << " = " << high;
  throw std::invalid_argument(message.str());
}

}  // namespace

void check(const SensorParameters& parameters) {
  visit_parameters(parameters, [](const ParameterInfo& info, const auto& value) {
    check_range(info, static_cast<double>(value));
  });
  const AdcParameters& adc = parameters.adc;
  check_order("adc.minimum", adc.minimum, "adc.maximum", adc.maximum);
  const PowerParameters& power = parameters.power;
  check_order("power.supply_voltage", power.supply_voltage, "power.brown_out_voltage",
              power.brown_out_voltage);
  check_order("power.brown_out_voltage", power.brown_out_voltage, "power.power_on_voltage",
              power.power_on_voltage);
  check_order("power.power_on_voltage", power.power_on_voltage, "power.maximum_voltage",
              power.maximum_voltage);
  if (power.initial_voltage > power.maximum_voltage) {
    throw std::invalid_argument(
        "power.initial_voltage must not be greater than power.maximum_voltage");
  }
}

}  // namespace sensor
