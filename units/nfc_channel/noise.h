// Random numbers without a generator's state: each is a function of the seed and of a counter.
#ifndef STRIDE_UNITS_NFC_CHANNEL_NOISE_H
#define STRIDE_UNITS_NFC_CHANNEL_NOISE_H

#include <array>
#include <cstdint>

#include "units/nfc/frame.h"

namespace nfc_channel {

/// Philox 4x32-10: 128 random bits for a counter and a key (Salmon et al., "Parallel Random
/// Numbers: As Easy as 1, 2, 3", SC11, 2011).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Names a frame among all those of a run: the stream keeps the two directions apart.
struct FrameNumber {
  std::uint32_t stream;
  std::uint64_t number;
};

/// A number from [0, 1) for one bit of one frame, uniform and independent of all others.
double uniform(std::uint64_t seed, FrameNumber frame, std::uint32_t bit);

/// Flips each bit with the given probability. The same seed and frame number flip the same bits.
nfc::Bits with_errors(nfc::Bits bits, double probability, std::uint64_t seed, FrameNumber frame);

}  // namespace nfc_channel

#endif
