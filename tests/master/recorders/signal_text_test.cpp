#include "master/recorders/signal_text.h"

#include <catch2/catch.hpp>

#include "tests/master/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;

TEST_CASE("Elements of arrays are counted from 1, the last index first") {
  core::Variable v = variable("a.b", 1, core::ValueType::Float64);
  CHECK(element_name(v, 0) == "a.b");
  v.dimensions = {3};
  CHECK(element_name(v, 0) == "a.b[1]");
  CHECK(element_name(v, 2) == "a.b[3]");
  v.dimensions = {2, 3};
  CHECK(element_name(v, 0) == "a.b[1,1]");
  CHECK(element_name(v, 2) == "a.b[1,3]");
  CHECK(element_name(v, 3) == "a.b[2,1]");
}

TEST_CASE("Fields are quoted where their text demands it") {
  CHECK(csv_field("plain [m]") == "plain [m]");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("a \"b\"") == "\"a \"\"b\"\"\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
}
