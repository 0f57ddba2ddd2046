#include "master/engine/run/events/bit_errors.h"

#include <algorithm>
#include <random>

namespace stride::core {
namespace {

std::mt19937_64 make_engine(const BitErrorSource& source) {
  std::seed_seq sequence{source.seed, source.seed >> 32, source.number, source.number >> 32};
  return std::mt19937_64(sequence);
}

}  // namespace

std::size_t invert_bits(std::span<const std::span<std::uint8_t>> values, std::size_t count,
                        const BitErrorSource& source) {
  std::size_t left = 0;
  for (const std::span<std::uint8_t> bytes : values) left += 8 * bytes.size();
  const std::size_t inverted = std::min(count, left);
  std::size_t wanted = inverted;
  std::mt19937_64 engine = make_engine(source);
  // selection sampling, Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S
  for (const std::span<std::uint8_t> bytes : values) {
    for (std::size_t bit = 0; bit < 8 * bytes.size() && wanted > 0; ++bit, --left) {
      if (engine() % left >= wanted) continue;
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      --wanted;
    }
  }
  return inverted;
}

}  // namespace stride::core
