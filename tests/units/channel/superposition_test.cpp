#include "units/channel/superposition.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

#include "tests/units/channel/answer.h"

using namespace channel::tests;
using channel::superposed;
using nfc::Bytes;
using nfc::Frame;
using stride::Duration;
using stride::Time;

namespace {

bool is_good(const Frame& frame) {
  const auto bytes = nfc::to_bytes(frame.bits);
  return bytes && nfc::without_crc(*bytes);
}

}  // namespace

TEST_CASE("Tags that answer the same at the same time are heard as one") {
  const Frame frame = answer({0, 7, 9});
  CHECK(superposed({frame, frame}) == frame);
  Frame late = frame;
  late.start += kBit / 20;
  CHECK(superposed({late, frame}) == frame);
  CHECK(is_good(superposed({frame, late, frame})));
}

TEST_CASE("Where two answers differ there is a collision, and never a good frame") {
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 5000; ++i) {
    const auto random = [&] { return static_cast<std::uint8_t>(byte(generator)); };
    const Bytes one = {0, random(), random(), random()};
    Bytes other = one;
    other[static_cast<std::size_t>(i % 4)] ^= static_cast<std::uint8_t>(1 << (i % 8));
    const Frame heard = superposed({answer(one), answer(other)});
    CHECK(heard.bits.size() == answer(one).bits.size());
    CHECK_FALSE(is_good(heard));
  }
}

TEST_CASE("Bits before the first collision are heard") {
  const Frame one = answer({0x00, 0x55, 0x0F});
  const Frame other = answer({0x00, 0x55, 0x1F});
  const Frame heard = superposed({one, other});
  const std::size_t collision = 2 * 9 + 4;
  CHECK(std::equal(one.bits.begin(), one.bits.begin() + collision, heard.bits.begin()));
  CHECK(heard.bits[collision] == 1);
}

TEST_CASE("A longer answer goes on after a shorter one, and is not a good frame") {
  const Frame heard = superposed({answer({0}), answer({0, 1, 2, 3})});
  CHECK(heard.bits.size() == answer({0, 1, 2, 3}).bits.size());
  CHECK_FALSE(is_good(heard));
}

TEST_CASE("Frames out of step collide wherever they overlap") {
  for (const auto& late : {kBit / 2, 3 * kBit + kBit / 3, 20 * kBit, 20 * kBit + kBit / 8}) {
    const Frame first = answer({0, 1, 2});
    const Frame second = answer({0, 1, 2}, kStart + late);
    const Frame heard = superposed({second, first});
    CHECK(heard.start == first.start);
    CHECK(heard.start + nfc::air_time(heard) >= second.start + nfc::air_time(second) - kBit);
    CHECK_FALSE(is_good(heard));
  }
}

TEST_CASE("A frame of another bit rate is out of step") {
  Frame fast = answer({0, 1, 2});
  fast.bit_rate = 212;
  CHECK_FALSE(is_good(superposed({answer({0, 1, 2}), fast})));
}
