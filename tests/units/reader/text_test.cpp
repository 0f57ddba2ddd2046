#include "units/reader/text.h"

#include <catch2/catch.hpp>

TEST_CASE("Identifiers have eight hexadecimal digits") {
  CHECK(reader::hexadecimal(0x0A2B3C4D) == "0x0A2B3C4D");
  CHECK(reader::hexadecimal(0) == "0x00000000");
  CHECK(reader::hexadecimal(0xFFFFFFFF) == "0xFFFFFFFF");
}
