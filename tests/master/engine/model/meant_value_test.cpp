#include "master/engine/model/meant_value.h"

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("values of another form that have one meaning are understood, others are not") {
  CHECK(meant_value(ValueType::Boolean, "True") == "true");
  CHECK(meant_value(ValueType::Boolean, "FALSE true") == "false true");
  CHECK(meant_value(ValueType::Int32, "-2.0") == "-2");
  CHECK(meant_value(ValueType::UInt8, "3.") == "3");
  CHECK(meant_value(ValueType::Int32, "1e3 -2.5E1 +2.0") == "1000 -25 2");
  for (const char* text : {"2", "2.5", "2,0", ".0", "-.0", "2.0.0", "x.0", "", "1e-1", "--1.0",
                           "1e30", "+-1.0", "+5", "0x1p3", "1e", "nan"}) {
    CHECK_FALSE(meant_value(ValueType::Int32, text));
  }
  CHECK_FALSE(meant_value(ValueType::Boolean, "on"));
  CHECK_FALSE(meant_value(ValueType::Boolean, "0 1"));
  CHECK(meant_value(ValueType::Boolean, "1.0 0.0 -3 00 2.") == "true false true false true");
  CHECK(meant_value(ValueType::Boolean, "+5 +0 1e3 0e0") == "true false true false");
  CHECK_FALSE(meant_value(ValueType::Boolean, "2.5"));
  CHECK(meant_value(ValueType::Float64, "true 2.5 False") == "1 2.5 0");
  CHECK(meant_value(ValueType::UInt8, "TRUE") == "1");
  CHECK_FALSE(meant_value(ValueType::Enumeration, "true"));
  CHECK_FALSE(meant_value(ValueType::Float64, "2.0"));
  CHECK_FALSE(meant_value(ValueType::String, "True"));
}
