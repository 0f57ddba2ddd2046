// Random numbers without a generator's state, so that a restored unit draws the same again.
#ifndef STRIDE_TESTS_TEST_UNITS_COUNTED_RANDOM_H
#define STRIDE_TESTS_TEST_UNITS_COUNTED_RANDOM_H

#include <cstdint>

namespace stride::tests {

/// 64 random bits for a seed and a count: SplitMix64 at that place of its sequence (Steele, Lea,
/// Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t count) {
  std::uint64_t z = seed + (count + 1) * 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31);
}

/// Uniform in [0, 1).
inline double random_uniform(std::uint64_t seed, std::uint64_t count) {
  return static_cast<double>(random_bits(seed, count) >> 11) * 0x1p-53;
}

}  // namespace stride::tests

#endif
