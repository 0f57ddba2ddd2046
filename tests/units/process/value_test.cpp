// Values as text and back, exactly.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <valarray>

#include <catch2/catch.hpp>

#include <stride/process/value.h>

using namespace stride::process;

namespace {

template <class T>
std::string text_of(const T& value) {
  std::string text;
  append_value(text, value);
  return text;
}

template <class T>
T read(const std::string& text) {
  T value{};
  parse_value(text, value);
  return value;
}

/// Any bits that are a number.
template <class T, class Bits>
void check_round_trips() {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const auto bits = static_cast<Bits>(random());
    T value{};
    std::memcpy(&value, &bits, sizeof value);
    if (std::isnan(value)) continue;
    REQUIRE(is_same(read<T>(text_of(value)), value));
  }
}

template <class T>
void check_limits() {
  for (const T value : {std::numeric_limits<T>::min(), T{0}, std::numeric_limits<T>::max()}) {
    CHECK(read<T>(text_of(value)) == value);
  }
  CHECK_THROWS_AS(read<T>("18446744073709551616"), std::invalid_argument);
}

}  // namespace

TEST_CASE("numbers read back as they were, bit by bit") {
  check_round_trips<double, std::uint64_t>();
  check_round_trips<float, std::uint32_t>();
  CHECK(text_of(0.1) == "0.1");
  CHECK(text_of(-0.0) == "-0");
  CHECK(std::signbit(read<double>("-0")));
  CHECK(text_of(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(read<double>("-inf") == -std::numeric_limits<double>::infinity());
  CHECK(read<double>("INF") == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(read<double>(text_of(std::nan("")))));
}

TEST_CASE("integers of all sizes, up to their limits") {
  check_limits<std::int8_t>();
  check_limits<std::uint8_t>();
  check_limits<std::int16_t>();
  check_limits<std::uint16_t>();
  check_limits<std::int32_t>();
  check_limits<std::uint32_t>();
  check_limits<std::int64_t>();
  check_limits<std::uint64_t>();
  CHECK_THROWS_WITH(read<std::int8_t>("128"),
                    "'128' is not a valid Int8; expected a whole number within its range");
  CHECK_THROWS_WITH(read<std::uint8_t>("-1"), Catch::Contains("not a valid UInt8"));
}

TEST_CASE("truth and bytes") {
  CHECK(text_of(true) == "true");
  CHECK_FALSE(read<bool>("false"));
  CHECK_THROWS_WITH(read<bool>("1"), "'1' is not a valid Boolean; expected true or false");
  CHECK(text_of(Binary{0, 15, 255}) == "000fff");
  CHECK(read<Binary>("000FfF") == Binary{0, 15, 255});
  CHECK(read<Binary>("").empty());
  for (const char* bad : {"0", "0g", "00 "}) {
    CHECK_THROWS_WITH(read<Binary>(bad), Catch::Contains("two hexadecimal digits for each byte"));
  }
}

TEST_CASE("no number is read from more or less than one") {
  for (const char* bad : {"", " 1", "1 ", "1,5", "0x10", "1.5e", "one"}) {
    CHECK_THROWS_AS(read<double>(bad), std::invalid_argument);
    CHECK_THROWS_AS(read<std::int32_t>(bad), std::invalid_argument);
  }
  CHECK_THROWS_WITH(read<double>(std::string(500, 'x')),
                    Catch::Contains("xxx…' is not a valid Float64"));
}

TEST_CASE("elements of arrays have a blank between them") {
  using Vector = std::array<double, 3>;
  CHECK(text_of(Vector{0.1, -0.0, 2}) == "0.1 -0 2");
  CHECK(is_same(read<Vector>("0.1 -0 2"), Vector{0.1, -0.0, 2}));
  CHECK_FALSE(is_same(read<Vector>("0.1 0 2"), Vector{0.1, -0.0, 2}));
  CHECK(is_same(read<Vector>(" nan  1 2 "), Vector{read<double>("nan"), 1, 2}));
  std::valarray<bool> flags(2);
  parse_value("true false", flags);
  CHECK(text_of(flags) == "true false");
  CHECK(is_same(flags, std::valarray<bool>{true, false}));
  CHECK(text_of(std::valarray<std::uint8_t>{1, 255}) == "1 255");
  CHECK_THROWS_WITH(read<Vector>("1 2"), "has 2 elements; expected 3");
  CHECK_THROWS_WITH(read<Vector>("1 2 3 4"), Catch::Contains("more elements than the 3"));
  CHECK_THROWS_WITH(read<Vector>("1 b 3"), Catch::Contains("'b' is not a valid Float64"));
}

TEST_CASE("names of types") {
  CHECK(std::string(type_name<double>()) == "Float64");
  CHECK(std::string(type_name<std::uint16_t>()) == "UInt16");
  CHECK(std::string(type_name<Binary>()) == "Binary");
}

TEST_CASE("what is not valid text of XML in UTF-8 is found") {
  CHECK(first_unfit("tab\t, ß, €, 😀") == std::string::npos);
  CHECK(first_unfit("a\x01") == 1);
  for (const char* bad : {"\x80", "\xC3", "\xC0\x80", "\xED\xA0\x80", "\xEF\xBF\xBF",
                          "\xF5\x80\x80\x80", "\xE2\x82x"}) {
    CHECK(first_unfit(std::string("ab") + bad) == 2);
  }
}
