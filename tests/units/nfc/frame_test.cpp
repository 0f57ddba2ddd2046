#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include <stride/nfc/frame.h>

using nfc::Bytes;
using nfc::Frame;
using stride::Duration;
using stride::Time;

TEST_CASE("A bit lasts 128, 64, 32 or 16 carrier periods") {
  for (const auto& [rate, periods] : {std::pair{106U, 128}, {212U, 64}, {424U, 32}, {848U, 16}}) {
    const double expected = periods / 13.56e6;
    CHECK(std::abs(stride::to_seconds(nfc::bit_duration(rate)) - expected) <= 0.5e-12);
  }
  CHECK(nfc::bit_duration(106) == Duration(9439528));  // 9.4395 us
}

TEST_CASE("A bit rate that is none of the four is refused and named") {
  CHECK_THROWS_WITH(nfc::bit_duration(0), Catch::Contains("106, 212, 424 or 848"));
  CHECK_THROWS_WITH(nfc::bit_duration(105), Catch::Contains("105 kbit/s"));
}

TEST_CASE("The time on the air is that of the bits, of the start and of the end") {
  Frame frame;
  CHECK(nfc::air_time(frame) == 2 * nfc::bit_duration(106));
  frame.bits.assign(27, 1);
  CHECK(nfc::air_time(frame) == 29 * nfc::bit_duration(106));
  frame.bit_rate = 848;
  CHECK(nfc::air_time(frame) == 29 * nfc::bit_duration(848));
}

TEST_CASE("The bytes of a frame are laid out as documented") {
  Frame frame{Time(Duration(0x0102030405060708)), 212, {1, 0, 0, 0, 0, 0, 0, 0, 1, 1}};
  CHECK(nfc::encode(frame) == Bytes{8, 7, 6, 5, 4, 3, 2, 1,  // start
                                    212, 0, 0, 0,            // bit rate
                                    10, 0, 0, 0,             // number of bits
                                    0x01, 0x03});
}

TEST_CASE("A frame survives encoding, whatever its length") {
  for (std::size_t length = 0; length <= 40; ++length) {
    Frame frame{Time(Duration(14'200'000'000'000)), 424, {}};
    for (std::size_t i = 0; i < length; ++i) frame.bits.push_back((i * i / 3) % 2);
    const Frame again = nfc::decode(nfc::encode(frame));
    CHECK(again == frame);
  }
}

TEST_CASE("Bytes that are not a frame are refused with a reason") {
  const Bytes good = nfc::encode({Time{}, 106, {1, 0, 1, 1, 0, 0, 1, 1, 1}});
  CHECK_THROWS_WITH(nfc::decode({}), Catch::Contains("at least 16 bytes"));
  CHECK_THROWS_WITH(nfc::decode(Bytes(good.begin(), good.begin() + 15)), Catch::Contains("has 15"));

  Bytes short_of_bits(good.begin(), good.end() - 1);
  CHECK_THROWS_WITH(nfc::decode(short_of_bits), Catch::Contains("a frame of 9 bits has 18 bytes"));

  Bytes too_long = good;
  too_long.push_back(0);
  CHECK_THROWS_AS(nfc::decode(too_long), std::invalid_argument);

  Bytes wrong_rate = good;
  wrong_rate[8] = 107;
  CHECK_THROWS_WITH(nfc::decode(wrong_rate), Catch::Contains("107 kbit/s"));

  Bytes huge = good;
  for (std::size_t i = 12; i < 16; ++i) huge[i] = 0xFF;
  CHECK_THROWS_AS(nfc::decode(huge), std::invalid_argument);
}

TEST_CASE("A frame that is cut off keeps the bits that are out, and its start") {
  const Frame whole{Time(Duration(14'200'000'000'123)), 212, {1, 0, 1, 1, 0, 1, 0, 0, 1}};
  const Duration bit = nfc::bit_duration(212);
  const auto bits_at = [&](Duration after) {
    const Frame cut = nfc::cut_off(whole, whole.start + after);
    CHECK(cut.start == whole.start);
    CHECK(cut.bit_rate == whole.bit_rate);
    CHECK(std::equal(cut.bits.begin(), cut.bits.end(), whole.bits.begin()));
    return cut.bits.size();
  };
  CHECK(bits_at(Duration(0)) == 0);
  CHECK(bits_at(2 * bit - Duration(1)) == 0);  // not one whole bit
  CHECK(bits_at(2 * bit) == 1);
  CHECK(bits_at(6 * bit + bit / 2) == 5);
  CHECK(bits_at(10 * bit - Duration(1)) == 8);
  CHECK(bits_at(10 * bit) == 9);
  CHECK(bits_at(nfc::air_time(whole)) == 9);
  CHECK(bits_at(1000 * bit) == 9);
}

TEST_CASE("The air time of a frame that was cut off ends one bit after the cut") {
  const Frame whole{Time(Duration(77)), 106, nfc::Bits(27, 1)};
  for (std::size_t count = 1; count <= 27; ++count) {
    const Time cut = whole.start + nfc::bit_duration(106) * static_cast<std::int64_t>(count + 1);
    const Frame heard = nfc::cut_off(whole, cut);
    CHECK(heard.bits.size() == count);
    CHECK(heard.start + nfc::air_time(heard) == cut + nfc::bit_duration(106));
  }
}
