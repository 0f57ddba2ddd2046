#include "master/engine/model/unit_of_measure.h"

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("units with the same base are converted, also those with an offset") {
  const UnitOfMeasure metre{"m", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0}};
  const UnitOfMeasure centimetre{"cm", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 0.01, 0}};
  const UnitOfMeasure kelvin{"K", BaseUnitOfMeasure{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0}};
  const UnitOfMeasure celsius{"degC", BaseUnitOfMeasure{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15}};
  CHECK(convert(centimetre, metre)->factor == Approx(1e-2));
  CHECK(convert(metre, centimetre)->factor == Approx(1e2));
  const auto to_kelvin = convert(celsius, kelvin);
  CHECK(to_kelvin->factor * 20 + to_kelvin->offset == Approx(293.15));
  const auto to_celsius = convert(kelvin, celsius);
  CHECK(to_celsius->factor * 293.15 + to_celsius->offset == Approx(20));
}

TEST_CASE(
    "units of another kind are not, and those that are missing or alike are taken as they are") {
  const UnitOfMeasure centimetre{"cm", BaseUnitOfMeasure{{0, 1, 0, 0, 0, 0, 0, 0}, 0.01, 0}};
  const UnitOfMeasure second{"s", BaseUnitOfMeasure{{0, 0, 1, 0, 0, 0, 0, 0}, 1, 0}};
  const UnitOfMeasure furlong{"furlong", {}};
  CHECK_FALSE(convert(centimetre, second));
  CHECK_FALSE(convert(centimetre, furlong));
  CHECK(convert({}, centimetre)->is_identity());
  CHECK(convert(furlong, furlong)->is_identity());
}

TEST_CASE("a name in brackets is that of the same unit") {
  CHECK(convert({"[m]"}, {"m"}));
  CHECK(convert({"kg/m3"}, {"[kg/m3]"}));
  CHECK_FALSE(convert({"[furlong]"}, {"m"}));
  CHECK_FALSE(convert({"[m"}, {"m"}));
}

TEST_CASE("a unit without a definition is what is known by its name") {
  CHECK(convert({"km/h"}, {"m/s"})->factor == 1 / 3.6);
  CHECK(convert({"m/s"}, {"km/h"})->factor == 3.6);
  CHECK(convert({"mm"}, {"um"})->factor == 1000);
  CHECK(convert({"degF"}, {"degC"})->factor == 5 / 9.0);
  CHECK(convert({"degF"}, {"degC"})->offset == -160 / 9.0);
  CHECK_FALSE(convert({"1/min"}, {"rad/s"}));
  CHECK_FALSE(convert({"bar"}, {"N"}));
}

TEST_CASE("a definition goes before what is known, and one name is one unit if it has only one") {
  const BaseUnitOfMeasure own{{0, 0, -1, 0, 0, 0, 0, 0}, 1 / 60.0L, 0};
  CHECK(convert({"rpm", own}, {"Hz"})->factor == 1 / 60.0);
  CHECK_FALSE(convert({"rpm", own}, {"rad/s"}));
  CHECK(convert({"rpm", own}, {"rpm"})->is_identity());
  CHECK(convert({"\u00B5m"}, {"um"})->is_identity());
}

TEST_CASE("a definition is also one of its powers and quotients") {
  using stride::core::find_defined;
  const stride::core::UnitsOfMeasure units{{"furlong", {{0, 1, 0, 0, 0, 0, 0, 0}, 200, 0}},
                                           {"km/h", {{0, 1, -1, 0, 0, 0, 0, 0}, 1, 0}}};
  CHECK(find_defined(units, "furlong")->factor == 200);
  CHECK(find_defined(units, "furlong/s")->factor == 200);
  CHECK(find_defined(units, "furlong2")->factor == 40'000);
  CHECK(find_defined(units, "km/h")->factor == 1);
  CHECK_FALSE(find_defined(units, "m/s"));
  CHECK_FALSE(find_defined(units, "league/s"));
  CHECK_FALSE(find_defined({}, "furlong"));
}
