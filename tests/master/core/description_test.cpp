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

TEST_CASE("a structural parameter resizes the arrays that depend on it") {
  UnitDescription unit = *Describe("a")
                              .add("n", ValueType::UInt64, Causality::StructuralParameter)
                              .input("u")
                              .size(4)
                              .input("v")
                              .size(4)
                              .done();
  unit.variables[1].dimensions = {{2, ValueReference{0}}, 2};
  CHECK(unit.resize(0, 5) == nullptr);
  CHECK(unit.variables[1].dimensions == std::vector<Dimension>{{5, ValueReference{0}}, 2});
  CHECK(unit.variables[1].size == 10);
  CHECK(unit.variables[2].size == 4);
  CHECK(unit.resize(0, kMaxElements) == &unit.variables[1]);
  CHECK(unit.variables[1].size == 10);
}

TEST_CASE("the elements of an array are counted up to a limit") {
  CHECK(element_count({}) == 1U);
  CHECK(element_count({2, 3}) == 6U);
  CHECK(element_count({kMaxElements, kMaxElements, 0}) == std::nullopt);
  CHECK(element_count({0, kMaxElements}) == 0U);
  CHECK_FALSE(element_count({kMaxElements + 1}));
}

TEST_CASE("variables are found by name and by value reference") {
  const auto a = Describe("a").input("u").output("y").done();
  CHECK(a->find("y") == 1U);
  CHECK(a->find(ValueReference{0}) == 0U);
  CHECK_FALSE(a->find("z"));
}
