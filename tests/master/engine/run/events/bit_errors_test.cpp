#include "master/engine/run/events/bit_errors.h"

#include <array>
#include <bit>
#include <vector>

#include <catch2/catch.hpp>

using stride::core::invert_bits;

namespace {

using Bytes = std::vector<std::uint8_t>;

int ones(const Bytes& bytes) {
  int count = 0;
  for (const std::uint8_t byte : bytes) count += std::popcount(byte);
  return count;
}

}  // namespace

TEST_CASE("as many bits as wanted are inverted, and no bit twice") {
  for (std::uint64_t number = 0; number < 200; ++number) {
    Bytes first(3), second(5);
    const std::array<std::span<std::uint8_t>, 2> values{first, second};
    CHECK(invert_bits(values, 7, {1, number}) == 7);
    CHECK(ones(first) + ones(second) == 7);
  }
}

TEST_CASE("where there are no more bits all are inverted") {
  Bytes bytes(2), none;
  const std::array<std::span<std::uint8_t>, 2> values{bytes, none};
  CHECK(invert_bits(values, 17, {1, 1}) == 16);
  CHECK(bytes == Bytes{0xff, 0xff});
  CHECK(invert_bits({}, 1, {1, 1}) == 0);
}

TEST_CASE("each bit is as likely as any other one") {
  constexpr int kTrials = 24'000;
  std::array<int, 24> counts{};
  for (int i = 0; i < kTrials; ++i) {
    Bytes bytes(3);
    const std::span<std::uint8_t> value = bytes;
    invert_bits({&value, 1}, 2, {42, static_cast<std::uint64_t>(i)});
    for (std::size_t bit = 0; bit < 24; ++bit) counts[bit] += (bytes[bit / 8] >> (bit % 8)) & 1;
  }
  // 2000 of each are expected; the standard deviation is 43
  for (const int count : counts) CHECK(std::abs(count - kTrials / 12) < 5 * 43);
}

TEST_CASE("seed and number choose the bits") {
  const auto corrupted = [](stride::core::BitErrorSource source) {
    Bytes bytes(16);
    const std::span<std::uint8_t> value = bytes;
    invert_bits({&value, 1}, 8, source);
    return bytes;
  };
  CHECK(corrupted({1, 2}) == corrupted({1, 2}));
  CHECK(corrupted({1, 2}) != corrupted({1, 3}));
  CHECK(corrupted({1, 2}) != corrupted({2, 2}));
}
