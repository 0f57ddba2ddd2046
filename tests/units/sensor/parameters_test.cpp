#include "units/sensor/parameters.h"

#include <limits>
#include <set>
#include <string>

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using sensor::SensorParameters;

TEST_CASE("the defaults are valid") { CHECK_NOTHROW(sensor::check(SensorParameters())); }

TEST_CASE("each parameter has a name of its own and is checked at both ends") {
  std::set<std::string> names;
  SensorParameters parameters;
  sensor::visit_parameters(parameters, [&](const sensor::ParameterInfo& info, auto& value) {
    CAPTURE(info.name);
    CHECK(names.insert(info.name).second);
    if constexpr (std::is_same_v<decltype(value), double&>) {
      const double kept = value;
      for (const double wrong :
           {info.minimum - 1, info.maximum * 1.1 + 1, std::numeric_limits<double>::quiet_NaN()}) {
        value = wrong;
        CHECK_THROWS_WITH(sensor::check(parameters), Contains(info.name));
      }
      value = kept;
    }
  });
  CHECK(names.count("power.capacitance") == 1);
  CHECK_NOTHROW(sensor::check(parameters));
}

TEST_CASE("thresholds must be in order") {
  SensorParameters parameters;
  parameters.power.power_on_voltage = parameters.power.brown_out_voltage;
  CHECK_THROWS_WITH(sensor::check(parameters), Contains("must be less than"));
  parameters = SensorParameters();
  parameters.power.supply_voltage = parameters.power.brown_out_voltage;
  CHECK_THROWS_WITH(sensor::check(parameters), Contains("power.supply_voltage"));
  parameters = SensorParameters();
  parameters.power.initial_voltage = 5.1;
  CHECK_THROWS_WITH(sensor::check(parameters), Contains("initial_voltage"));
  parameters = SensorParameters();
  parameters.adc.maximum = parameters.adc.minimum;
  CHECK_THROWS_WITH(sensor::check(parameters), Contains("adc.maximum"));
}
