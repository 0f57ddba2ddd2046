// Bytes as hexadecimal digits, and a type's name in errors; all else is tested as the process
// protocol has it (tests/units/process/value_test.cpp).
#include <catch2/catch.hpp>

#include <stride/value_text.h>

using namespace stride;

TEST_CASE("bytes are two hexadecimal digits each, of either case when read") {
  std::string text;
  for (const int byte : {0, 0x0F, 0xA5, 0xFF}) {
    append_hexadecimal(text, static_cast<std::uint8_t>(byte));
  }
  CHECK(text == "000fa5ff");
  Binary bytes;
  CHECK(parse_hexadecimal("000Fa5fF", bytes));
  CHECK(bytes == Binary{0, 0x0F, 0xA5, 0xFF});
  CHECK(parse_hexadecimal("", bytes));
  CHECK(bytes.empty());
  for (const char* bad : {"0", "0g", "/0", "@0", "`0", "0 "}) {
    INFO(bad);
    CHECK_FALSE(parse_hexadecimal(bad, bytes));
  }
}

TEST_CASE("an error names the type, as it is called where the value is") {
  std::int64_t item = 0;
  CHECK_THROWS_WITH(parse_value("red", item, type_name(Type::Enumeration)),
                    "'red' is not a valid Enumeration; expected a whole number within its range");
  CHECK_THROWS_WITH(parse_value("red", item),
                    "'red' is not a valid Int64; expected a whole number within its range");
}

TEST_CASE("a text is cut between characters") {
  CHECK(whole_characters("aö€", 6) == 6);
  CHECK(whole_characters("aö€", 9) == 6);
  CHECK(whole_characters("aö€", 5) == 3);
  CHECK(whole_characters("aö€", 3) == 3);
  CHECK(whole_characters("aö€", 2) == 1);
  CHECK(whole_characters("ö", 1) == 0);
  CHECK(whole_characters("", 0) == 0);
}

TEST_CASE("an error cuts a long text at the start of a character") {
  std::string text = "1";
  for (int i = 0; i < 40; ++i) text += "ö";
  std::string shown = "1";
  for (int i = 0; i < 29; ++i) shown += "ö";
  double number = 0;
  CHECK_THROWS_WITH(parse_value(text, number),
                    "'" + shown + "…' is not a valid Float64; expected a number such as 1.5e-06");
  const std::string longest(60, 'x');
  CHECK_THROWS_WITH(parse_value(longest, number),
                    "'" + longest + "' is not a valid Float64; expected a number such as 1.5e-06");
}

TEST_CASE("every type has its name of FMI 3.0") {
  CHECK(type_name(Type::Float32) == std::string("Float32"));
  CHECK(type_name(Type::Enumeration) == std::string("Enumeration"));
  CHECK(type_name(Type::Clock) == std::string("Clock"));
  CHECK(type_name<std::uint64_t>() == std::string("UInt64"));
  CHECK(type_name<Binary>() == std::string("Binary"));
}
