#include "master/base/text/hex.h"

#include <catch2/catch.hpp>

using namespace stride::core;
using Bytes = std::vector<std::uint8_t>;

TEST_CASE("bytes become two digits each, and bytes again") {
  CHECK(to_hex(Bytes{}).empty());
  CHECK(to_hex(Bytes{0x00, 0x0f, 0xa0, 0xff}) == "000fa0ff");
  CHECK(from_hex("000fa0ff") == Bytes{0x00, 0x0f, 0xa0, 0xff});
  CHECK(from_hex("0FAf") == Bytes{0x0f, 0xaf});
  CHECK(from_hex("") == Bytes{});
}

TEST_CASE("what is not a pair of digits is not a byte") {
  for (const char* text : {"", "1", "g0", "0g", "-1", "+1", " 1", "0x"})
    CHECK_FALSE(hex_byte(text));
  CHECK(hex_byte("7fz") == 0x7f);
  CHECK_FALSE(from_hex("123"));
  CHECK_FALSE(from_hex("12 3"));
}
