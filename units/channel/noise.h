// Random numbers without a generator's state: each is a function of the seed and of a counter.
#ifndef STRIDE_UNITS_CHANNEL_NOISE_H
#define STRIDE_UNITS_CHANNEL_NOISE_H

#include <array>
#include <cstdint>

namespace channel {

/// Philox 4x32-10: 128 random bits for a counter and a key (Salmon et al., "Parallel Random
/// Numbers: As Easy as 1, 2, 3", SC11, 2011).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Names a frame at a receiver among all those of a run: the stream keeps directions and tags
/// apart.
struct FrameNumber {
  std::uint32_t stream;
  std::uint64_t number;
};

/// A number from [0, 1) for one bit of one frame, uniform and independent of all others.
double uniform(std::uint64_t seed, FrameNumber frame, std::uint32_t bit);

}  // namespace channel

#endif
