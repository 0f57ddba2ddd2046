#include "units/player/values.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace player;

namespace {

template <class T>
T parsed(Type type, const std::string& text) {
  Values values = values_of(type);
  append_parsed(values, type, text);
  return std::get<std::vector<T>>(values).at(0);
}

std::string refusal(Type type, const std::string& text) {
  Values values = values_of(type);
  try {
    append_parsed(values, type, text);
  } catch (const std::invalid_argument& mistake) {
    return mistake.what();
  }
  return "";
}

}  // namespace

TEST_CASE("numbers read back as the bits that they were") {
  CHECK(parsed<double>(Type::Float64, "0.1") == 0.1);
  CHECK(parsed<double>(Type::Float64, "5e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(std::signbit(parsed<double>(Type::Float64, "-0")));
  CHECK(std::isinf(parsed<double>(Type::Float64, "inf")));
  CHECK(parsed<float>(Type::Float32, "0.1") == 0.1f);
  CHECK(parsed<std::int64_t>(Type::Int64, "-9223372036854775808") ==
        std::numeric_limits<std::int64_t>::min());
  CHECK(parsed<std::uint64_t>(Type::UInt64, "18446744073709551615") ==
        std::numeric_limits<std::uint64_t>::max());
  CHECK(parsed<std::int64_t>(Type::Enumeration, "7") == 7);
}

TEST_CASE("truth, text and bytes") {
  CHECK(parsed<bool>(Type::Boolean, "true"));
  CHECK(!parsed<bool>(Type::Boolean, "false"));
  CHECK(parsed<std::string>(Type::String, "any, \"thing\"") == "any, \"thing\"");
  CHECK(parsed<stride::Binary>(Type::Binary, "00fFa9") == stride::Binary{0, 255, 0xa9});
  CHECK(parsed<stride::Binary>(Type::Binary, "").empty());
}

TEST_CASE("what is not a value of the type is refused with what was expected") {
  CHECK(refusal(Type::Float64, "1,5") ==
        "'1,5' is not a valid Float64; expected a number such as 1.5e-06");
  CHECK(refusal(Type::Float64, "") != "");
  CHECK(refusal(Type::UInt8, "256") ==
        "'256' is not a valid UInt8; expected a whole number within its range");
  CHECK(refusal(Type::Int8, "1.0") != "");
  CHECK(refusal(Type::Boolean, "1") == "'1' is not a valid Boolean; expected true or false");
  CHECK(refusal(Type::Binary, "abc") ==
        "'abc' is not a valid Binary; expected two hexadecimal digits for each byte");
  CHECK(refusal(Type::Binary, "0g") != "");
}

TEST_CASE("types have the names of FMI 3.0") {
  CHECK(type_named("Enumeration") == Type::Enumeration);
  CHECK(type_named("Clock") == Type::Clock);
  CHECK_THROWS_WITH(type_named("Real"),
                    Catch::Contains("'Real' is not a type; expected Float32, "));
}

TEST_CASE("a value has the form in which it is read, where it can be meant in one way only") {
  CHECK(plain_value(Type::Float64, " 1.5\t") == "1.5");
  CHECK(plain_value(Type::Float64, "+1e3") == "1e3");
  CHECK(plain_value(Type::Float64, "+-1") == "+-1");
  CHECK(plain_value(Type::Float32, "2.0") == "2.0");
  CHECK(plain_value(Type::Int32, "2.0") == "2");
  CHECK(plain_value(Type::UInt8, "-1e1") == "-10");
  CHECK(plain_value(Type::Int64, "2.5") == "2.5");
  CHECK(plain_value(Type::Int64, "9007199254740993") == "9007199254740993");
  CHECK(plain_value(Type::UInt64, "1e300") == "1e300");
  CHECK(plain_value(Type::Int8, "nan") == "nan");
  for (const char* text : {"true", " True", "TRUE ", "1"}) {
    CHECK(plain_value(Type::Boolean, text) == "true");
  }
  for (const char* text : {"false", "False", "FALSE", "0"}) {
    CHECK(plain_value(Type::Boolean, text) == "false");
  }
  CHECK(plain_value(Type::Boolean, "yes") == "yes");
  CHECK(plain_value(Type::Binary, " 0aff ") == "0aff");
  CHECK(plain_value(Type::String, " a ") == " a ");
}
