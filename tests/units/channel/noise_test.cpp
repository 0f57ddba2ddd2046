#include "units/channel/noise.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

using namespace channel;
using Words = std::array<std::uint32_t, 4>;

namespace {

using Bits = std::vector<std::uint8_t>;

/// 1 where the bit would be wrong.
Bits errors(std::size_t length, double probability, std::uint64_t seed, FrameNumber frame) {
  Bits wrong(length);
  for (std::uint32_t i = 0; i < length; ++i) wrong[i] = uniform(seed, frame, i) < probability;
  return wrong;
}

std::size_t count(const Bits& bits) {
  std::size_t ones = 0;
  for (const auto bit : bits) ones += bit;
  return ones;
}

// five standard deviations of the binomial distribution: one false alarm in two million
double bound(std::size_t length, double probability) {
  return 5.0 * std::sqrt(static_cast<double>(length) * probability * (1.0 - probability));
}

}  // namespace

TEST_CASE("Philox gives the known answers that its authors publish") {
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("The share of wrong bits is the probability, within statistical bounds") {
  constexpr std::size_t kLength = 400'000;
  for (const double probability : {0.5, 0.1, 0.01, 0.0005}) {
    const double expected = kLength * probability;
    const double found = static_cast<double>(count(errors(kLength, probability, 7, {0, 3})));
    CHECK(std::abs(found - expected) < bound(kLength, probability));
  }
}

TEST_CASE("Short frames have as many wrong bits as long ones") {
  constexpr std::size_t kFrames = 10'000;
  constexpr std::size_t kLength = 27;
  std::size_t found = 0;
  for (std::uint64_t number = 0; number < kFrames; ++number) {
    found += count(errors(kLength, 0.05, 7, {1, number}));
  }
  const double expected = kFrames * kLength * 0.05;
  CHECK(std::abs(static_cast<double>(found) - expected) < bound(kFrames * kLength, 0.05));
}

TEST_CASE("Errors do not cluster: neighbours are wrong together as often as chance has it") {
  constexpr std::size_t kLength = 400'000;
  const auto wrong = errors(kLength, 0.1, 11, {0, 0});
  std::size_t pairs = 0;
  for (std::size_t i = 1; i < wrong.size(); ++i) pairs += wrong[i] & wrong[i - 1];
  CHECK(std::abs(static_cast<double>(pairs) - kLength * 0.01) < 1.2 * bound(kLength, 0.01));
}

TEST_CASE("The same seed and number repeat the errors; any other makes new ones") {
  const auto first = errors(1000, 0.1, 42, {0, 5});
  CHECK(errors(1000, 0.1, 42, {0, 5}) == first);
  CHECK(errors(1000, 0.1, 43, {0, 5}) != first);
  CHECK(errors(1000, 0.1, 42 + (std::uint64_t{1} << 32), {0, 5}) != first);
  CHECK(errors(1000, 0.1, 42, {1, 5}) != first);
  CHECK(errors(1000, 0.1, 42, {0, 6}) != first);
  CHECK(errors(1000, 0.1, 42, {0, 5 + (std::uint64_t{1} << 32)}) != first);
}

TEST_CASE("Where no bit can be wrong none is, and where each must be all are") {
  CHECK(count(errors(1000, 0.0, 1, {0, 0})) == 0);
  CHECK(count(errors(1000, 1.0, 1, {0, 0})) == 1000);
}

TEST_CASE("Numbers lie from 0 to below 1") {
  for (std::uint32_t bit = 0; bit < 10'000; ++bit) {
    const double number = uniform(3, {0, 0}, bit);
    CHECK((number >= 0.0 && number < 1.0));
  }
}
