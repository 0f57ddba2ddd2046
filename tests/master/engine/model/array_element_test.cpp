#include "master/engine/model/array_element.h"

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("Elements of arrays are counted from 1, the last index first") {
  Variable v;
  v.name = "a.b";
  CHECK(element_name(v, 0) == "a.b");
  v.dimensions = {3};
  CHECK(element_name(v, 0) == "a.b[1]");
  CHECK(element_name(v, 2) == "a.b[3]");
  v.dimensions = {2, 3};
  CHECK(element_name(v, 0) == "a.b[1,1]");
  CHECK(element_name(v, 2) == "a.b[1,3]");
  CHECK(element_name(v, 3) == "a.b[2,1]");
}

namespace {

Variable array_of(std::vector<Dimension> dimensions) {
  Variable variable;
  variable.name = "m";
  variable.dimensions = std::move(dimensions);
  return variable;
}

std::string element_mistake(const Variable& variable, const std::string& name) {
  try {
    element_at(variable, *indexed_name(name), {{"s.ssd", 7}, "unit", name, {}});
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("indices are read as they are written") {
  const auto indexed = indexed_name("a.b[2].m[1,12]");
  REQUIRE(indexed);
  CHECK(indexed->array == "a.b[2].m");
  CHECK(indexed->brackets == "[1,12]");
  CHECK(indexed->indices == std::vector<std::size_t>{1, 12});
  for (const char* name : {"m[]", "m[1,]", "m[,1]", "m[+1]", "m[-1]", "m[01]", "m[ 1]", "m[2:3]",
                           "m[1.0]", "m[99999999999999999999999]"}) {
    INFO(name);
    CHECK(indexed_name(name).value().indices.empty());
  }
  for (const char* name : {"m", "m[1].x", "[1]", "m1]", ""}) CHECK_FALSE(indexed_name(name));
}

TEST_CASE("the name of each element leads back to it") {
  const Variable cube = array_of({2, 3, 4});
  for (std::size_t i = 0; i < 24; ++i) {
    CHECK(element_at(cube, *indexed_name(element_name(cube, i)), {}) == i);
  }
}

TEST_CASE("an element that an array does not have is an error with what is expected") {
  using Catch::Matchers::Contains;
  using Catch::Matchers::StartsWith;
  const Variable matrix = array_of({2, 3});
  CHECK_THAT(element_mistake(matrix, "m[2,4]"),
             StartsWith("s.ssd:7: unit 'unit', variable 'm[2,4]': 'm' is an array of 2 × 3 "
                        "elements, and the index 4 in [2,4] is not from 1 to 3"));
  CHECK_THAT(element_mistake(matrix, "m[0,1]"), Contains("hint: indices start at 1"));
  CHECK_THAT(element_mistake(matrix, "m[3,1]"), Contains("the index 3") && !Contains("hint"));
  CHECK_THAT(element_mistake(matrix, "m[2]"), Contains("so 2 indices are expected, and [2] has 1"));
  CHECK_THAT(element_mistake(array_of({3}), "m[1,2]"),
             Contains("so 1 index is expected, and [1,2] has 2"));
  CHECK_THAT(element_mistake(matrix, "m[1,2:3]"),
             Contains("[1,2:3] names none of them") && Contains("such as 'm[1,1]'"));
  CHECK_THAT(element_mistake(array_of({}), "m[1]"),
             Contains("'m' is a scalar, so it has no element [1]"));
}
