#include "master/engine/model/finite.h"

#include <catch2/catch.hpp>

using namespace stride::core;

namespace {

std::optional<std::string> lost(ValueType type, const std::string& text,
                                const LinearConversion& conversion = {}) {
  Variable variable;
  variable.type = type;
  const ValueBlock value = parse_converted(variable, text, conversion);
  return lost_number(text, value, conversion);
}

}  // namespace

TEST_CASE("numbers that are too near to 0 for their type are lost") {
  using T = ValueType;
  for (const char* text : {"0", "-0", "1", "1e-300", "2.2250738585072014e-308", "0.1", "inf",
                           "5e-324", "4.9406564584124654e-324"}) {
    CAPTURE(text);
    CHECK_FALSE(lost(T::Float64, text));
  }
  CHECK(lost(T::Float64, "1e-400") == "1e-400 becomes 0: Float64 has no such number so near to 0");
  CHECK(lost(T::Float64, "-1.2e-323"));
  CHECK_FALSE(lost(T::Float32, "1e-40"));  // it keeps four digits
  CHECK(lost(T::Float32, "1.2e-44"));
  CHECK(lost(T::Float32, "1e-50"));
  CHECK_FALSE(lost(T::Float32, "0.1"));
  CHECK_FALSE(lost(T::Int32, "0"));
}

TEST_CASE("whole numbers lose digits beyond those of their type") {
  using T = ValueType;
  CHECK(lost(T::Float64, "9007199254740993") ==
        "9007199254740993 becomes 9007199254740992: Float64 has fewer digits");
  CHECK(lost(T::Float64, "-9007199254740993"));
  CHECK(lost(T::Float32, "16777217"));
  for (const char* text : {"9007199254740992", "9223372036854775808", "123456789", "1.1"}) {
    CHECK_FALSE(lost(T::Float64, text));
  }
  CHECK_FALSE(lost(T::Float64, "100000000000000000000001"));  // no integer has so many
  CHECK_FALSE(lost(T::Int64, "9007199254740993"));
}

TEST_CASE("a Float32 is rounded once, behind its conversion") {
  Variable variable;
  variable.type = ValueType::Float32;
  const auto converted_value = [&](const std::string& text, double factor) {
    return parse_converted(variable, text, {factor, 0}).numbers<float>()[0];
  };
  CHECK(converted_value("1e-50", 1e30) == 1e-20F);
  CHECK(converted_value("1e40", 1e-3) == 1e37F);
  CHECK_THROWS_WITH(converted_value("1e38", 1e3), Catch::Contains("the range of Float32"));
  CHECK(std::isinf(converted_value("inf", 2)));
}

TEST_CASE("a conversion may lose a number, and an offset may make it 0") {
  CHECK(lost(ValueType::Float32, "1e-30", {1e-20, 0}));
  CHECK_FALSE(lost(ValueType::Float32, "1e-50", {1e20, 0}));
  CHECK_FALSE(lost(ValueType::Float64, "-273.15", {1, 273.15}));
  CHECK_FALSE(lost(ValueType::Float64, "1e-30", {1e-20, 0}));
}
