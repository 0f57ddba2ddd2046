#include "master/model/unit_of_measure.h"

#include <catch2/catch.hpp>

using namespace stride::core;

namespace {

const UnitOfMeasure kMetre{"m", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0}};
const UnitOfMeasure kCentimetre{"cm", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 0.01, 0}};
const UnitOfMeasure kSecond{"s", BaseUnitOfMeasure{{0, 0, 1, 0, 0, 0, 0, 0}, 1, 0}};

}  // namespace

TEST_CASE("units with the same base are converted, also those with an offset") {
  const UnitOfMeasure kelvin{"K", BaseUnitOfMeasure{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0}};
  const UnitOfMeasure celsius{"degC", BaseUnitOfMeasure{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15}};
  CHECK(convert(kCentimetre, kMetre)->factor == Approx(1e-2));
  CHECK(convert(kMetre, kCentimetre)->factor == Approx(1e2));
  const auto to_kelvin = convert(celsius, kelvin);
  CHECK(to_kelvin->factor * 20 + to_kelvin->offset == Approx(293.15));
  const auto to_celsius = convert(kelvin, celsius);
  CHECK(to_celsius->factor * 293.15 + to_celsius->offset == Approx(20));
}

TEST_CASE(
    "units of another kind are not, and those that are missing or alike are taken as they are") {
  const UnitOfMeasure furlong{"furlong", {}};
  CHECK_FALSE(convert(kCentimetre, kSecond));
  CHECK_FALSE(convert(kCentimetre, furlong));
  CHECK(convert({}, kCentimetre)->is_identity());
  CHECK(convert(furlong, furlong)->is_identity());
}
