#include "master/model/array_element.h"

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
