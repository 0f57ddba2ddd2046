#include "units/reader/text.h"

#include <catch2/catch.hpp>

TEST_CASE("Numbers are as short as they can be, and whole where they are") {
  CHECK(reader::shortest(14.2) == "14.2");
  CHECK(reader::shortest(24) == "24");
  CHECK(reader::shortest(-0.5) == "-0.5");
  CHECK(reader::shortest(0.1 + 0.2) == "0.30000000000000004");
}

TEST_CASE("Identifiers have eight hexadecimal digits") {
  CHECK(reader::hexadecimal(0x0A2B3C4D) == "0x0A2B3C4D");
  CHECK(reader::hexadecimal(0) == "0x00000000");
  CHECK(reader::hexadecimal(0xFFFFFFFF) == "0xFFFFFFFF");
}
