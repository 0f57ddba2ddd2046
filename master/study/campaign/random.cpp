#include "master/study/campaign/random.h"

#include <bit>

#include <Random123/philox.h>

#include "master/base/files/sha256.h"

namespace stride::campaign {
namespace {

std::uint64_t number_for(std::string_view purpose) {
  core::Sha256 hash;
  hash.add(purpose);
  const core::Sha256Digest digest = hash.digest();
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) number = number << 8 | digest[i];
  return number;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose)
    : seed_(seed), purpose_(number_for(purpose)) {}

std::uint64_t RandomStream::bits(std::uint64_t place, std::uint64_t round) const {
  return r123::Philox4x64()({{place, purpose_, round, 0}}, {{seed_, 0}})[0];
}

double RandomStream::uniform(std::uint64_t place) const {
  return (static_cast<double>(bits(place) >> 12) + 0.5) * 0x1p-52;
}

/// A Feistel network permutes the least even number of bits that has room for the places, but no
/// fewer than eight, of which few rounds would make few permutations. What is no place is permuted
/// on, until one comes (Black, Rogaway: "Ciphers with arbitrary finite domains", 2002).
std::uint64_t RandomStream::permuted(std::uint64_t place, std::uint64_t count) const {
  constexpr int kLeastBits = 4;
  constexpr std::uint64_t kRounds = 8;
  const int needed = (std::bit_width(count - 1) + 1) / 2;
  const int width = needed < kLeastBits ? kLeastBits : needed;
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  do {
    std::uint64_t left = place >> width, right = place & mask;
    for (std::uint64_t round = 1; round <= kRounds; ++round) {
      const std::uint64_t next = left ^ (bits(right, round) & mask);
      left = right;
      right = next;
    }
    place = left << width | right;
  } while (place >= count);
  return place;
}

}  // namespace stride::campaign
