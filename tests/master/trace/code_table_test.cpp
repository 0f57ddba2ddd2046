#include <catch2/catch.hpp>

#include "master/trace/header.h"

using namespace stride::trace;

TEST_CASE("Codes are numbered as they come, and equal ones are one") {
  CodeTable codes;
  CHECK(codes.add("!") == 0);
  CHECK(codes.add("aaaaa") == 1);
  CHECK(codes.add("a code of any length") == 2);
  CHECK(codes.add("!") == 0);
  CHECK(codes.add("a code of any length") == 2);
  CHECK(codes.size() == 3);
  CHECK(codes.find("aaaaa") == 1U);
  CHECK(codes.find("a code of any length") == 2U);
  for (const char* unknown : {"", "a", "aaaa", "aaaaaa", "a code of any", "\""}) {
    CHECK_FALSE(codes.find(unknown).has_value());
  }
}

TEST_CASE(
    "Tens of thousands of codes are found again, those of eight and of nine characters, too") {
  CodeTable codes;
  const auto code = [](std::uint32_t i) { return std::string(i % 10, '~') + std::to_string(i); };
  for (std::uint32_t i = 0; i < 50'000; ++i) REQUIRE(codes.add(code(i)) == i);
  for (std::uint32_t i = 0; i < 50'000; ++i) REQUIRE(codes.find(code(i)) == i);
  CHECK_FALSE(codes.find("50000").has_value());
  CHECK_FALSE(codes.find("~~~~~~~~~50009").has_value());
}
