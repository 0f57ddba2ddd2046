#include "units/sensor/adc.h"

#include <cmath>

#include <catch2/catch.hpp>

using sensor::AdcParameters;
using sensor::to_centidegrees;
using sensor::to_code;

TEST_CASE("the ADC's codes span its range and saturate") {
  const AdcParameters adc;
  CHECK(to_code(adc, -40.0) == 0);
  CHECK(to_code(adc, 125.0) == 4095);
  CHECK(to_code(adc, -273.0) == 0);
  CHECK(to_code(adc, 1e9) == 4095);
  CHECK(to_code(adc, 42.5) == 2048);  // 2047.5, rounded away from zero
}

TEST_CASE("an offset error shifts the result by as much") {
  AdcParameters adc;
  const double step = (adc.maximum - adc.minimum) / 4095;
  adc.offset_error = 10 * step;
  const AdcParameters calibrated;
  CHECK(to_code(adc, 21.5) == to_code(calibrated, 21.5) + 10);
  CHECK(to_code(adc, 125.0) == 4095);
  adc.offset_error = -10 * step;
  CHECK(to_code(adc, 21.5) == to_code(calibrated, 21.5) - 10);
}

TEST_CASE("the calibrated result is within half a code of the temperature") {
  const AdcParameters adc;
  const double half_code = (adc.maximum - adc.minimum) / 4095 / 2;
  for (double temperature = -40; temperature <= 125; temperature += 0.37) {
    const double result = to_centidegrees(adc, to_code(adc, temperature)) / 100.0;
    REQUIRE(std::abs(result - temperature) <= half_code + 0.005 + 1e-9);
  }
  CHECK(to_centidegrees(adc, 0) == -4000);
  CHECK(to_centidegrees(adc, 4095) == 12500);
}
