#include "master/engine/model/description.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;

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
