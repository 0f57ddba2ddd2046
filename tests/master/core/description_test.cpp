#include "master/core/description.h"

#include <catch2/catch.hpp>

#include "scripted_unit.h"

using namespace stride::core;

namespace {

const BaseUnit kMetre{{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0};
const BaseUnit kMillimetre{{0, 1, 0, 0, 0, 0, 0, 0}, 1e-3, 0};
const BaseUnit kKelvin{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 0};
const BaseUnit kCelsius{{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15};

}  // namespace

TEST_CASE("units with the same base are converted") {
  const auto a = Describe("a").unit("mm", kMillimetre).unit("degC", kCelsius).done();
  const auto b = Describe("b").unit("m", kMetre).unit("K", kKelvin).done();
  CHECK(convert(*a, "mm", *b, "m")->factor == Approx(1e-3));
  CHECK(convert(*b, "m", *a, "mm")->factor == Approx(1e3));
  const auto kelvin = convert(*a, "degC", *b, "K");
  CHECK(kelvin->factor * 20 + kelvin->offset == Approx(293.15));
  const auto celsius = convert(*b, "K", *a, "degC");
  CHECK(celsius->factor * 293.15 + celsius->offset == Approx(20));
}

TEST_CASE("units of another kind are not") {
  const auto a = Describe("a").unit("mm", kMillimetre).unit("K", kKelvin).done();
  CHECK_FALSE(convert(*a, "mm", *a, "K"));
  CHECK_FALSE(convert(*a, "mm", *a, "furlong"));
}

TEST_CASE("units that are missing or unknown but alike are taken as they are") {
  const auto a = Describe("a").unit("mm", kMillimetre).done();
  CHECK(convert(*a, "", *a, "mm")->is_identity());
  CHECK(convert(*a, "furlong", *a, "furlong")->is_identity());
}

TEST_CASE("variables are found by name and by value reference") {
  const auto a = Describe("a").input("u").output("y").done();
  CHECK(a->find("y") == 1U);
  CHECK(a->find(ValueReference{0}) == 0U);
  CHECK_FALSE(a->find("z"));
}
