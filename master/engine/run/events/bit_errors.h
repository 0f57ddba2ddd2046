#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_BIT_ERRORS_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_BIT_ERRORS_H

#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::core {

/// What chooses the bits: the same ones for the same numbers.
struct BitErrorSource {
  std::uint64_t seed;
  std::uint64_t number;  ///< of the message
};

/// Inverts so many of the bits, each of them being as likely as any other one, and none twice.
/// Returns how many it has inverted: fewer where there are no more.
std::size_t invert_bits(std::span<const std::span<std::uint8_t>> values, std::size_t count,
                        const BitErrorSource& source);

}  // namespace stride::core

#endif
