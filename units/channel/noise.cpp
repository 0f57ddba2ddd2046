#include "units/channel/noise.h"

namespace channel {
namespace {

std::uint32_t low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
std::uint32_t high(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  constexpr int kRounds = 10;
  constexpr std::uint64_t kMultiplier[] = {0xD2511F53, 0xCD9E8D57};
  constexpr std::uint32_t kWeyl[] = {0x9E3779B9, 0xBB67AE85};
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t even = kMultiplier[0] * counter[0];
    const std::uint64_t odd = kMultiplier[1] * counter[2];
    counter = {high(odd) ^ counter[1] ^ key[0], low(odd), high(even) ^ counter[3] ^ key[1],
               low(even)};
    key = {key[0] + kWeyl[0], key[1] + kWeyl[1]};
  }
  return counter;
}

double uniform(std::uint64_t seed, FrameNumber frame, std::uint32_t bit) {
  const auto words =
      philox({bit, frame.stream, low(frame.number), high(frame.number)}, {low(seed), high(seed)});
  const std::uint64_t random = std::uint64_t{words[0]} << 32 | words[1];
  return static_cast<double>(random >> 11) * 0x1p-53;
}

}  // namespace channel
