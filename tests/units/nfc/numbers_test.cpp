#include <catch2/catch.hpp>

#include <stride/nfc/numbers.h>

using namespace nfc;

TEST_CASE("the most significant byte comes first") {
  CHECK(most_significant_first(std::uint32_t{0x0A2B3C4D}) == Bytes{0x0A, 0x2B, 0x3C, 0x4D});
  CHECK(most_significant_first(std::uint16_t{0x0102}) == Bytes{0x01, 0x02});
}

TEST_CASE("a number is read from a part of the bytes") {
  const Bytes bytes = {0x05, 0x0A, 0x2B, 0x3C, 0x4D};
  CHECK(number_in(bytes, 1, 5) == 0x0A2B3C4D);
  CHECK(number_in(bytes, 0, 2) == 0x050A);
  CHECK(number_in(bytes, 5, 5) == 0);
}
