#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>

#include "master/util/xml/element.h"

using namespace stride;

TEST_CASE("a list is split at blanks of any kind") {
  using Words = std::vector<std::string_view>;
  CHECK(xml::split("").empty());
  CHECK(xml::split(" \t\n ").empty());
  CHECK(xml::split("1") == Words{"1"});
  CHECK(xml::split("\n1  22\t333 ") == Words{"1", "22", "333"});
}

TEST_CASE("a number is the whole word and within its type") {
  CHECK(xml::to_number<int>("-7") == -7);
  CHECK(xml::to_number<int>("+7") == 7);
  CHECK_FALSE(xml::to_number<int>("7x"));
  CHECK_FALSE(xml::to_number<int>(""));
  CHECK_FALSE(xml::to_number<std::uint32_t>("-1"));
  CHECK_FALSE(xml::to_number<std::uint32_t>("4294967296"));
  CHECK(xml::to_number<double>("1e-3") == 1e-3);
  CHECK(xml::to_number<double>("INF") == std::numeric_limits<double>::infinity());
}
