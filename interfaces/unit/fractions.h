// The intervals of clocks as fractions of a second.
#ifndef STRIDE_INTERFACES_UNIT_FRACTIONS_H
#define STRIDE_INTERFACES_UNIT_FRACTIONS_H

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

#include <stride/time.h>
#include <stride/time_text.h>

#include "interfaces/unit/misuse.h"

namespace stride::kit {

/// Two durations as counts of seconds / resolution.
struct Fractions {
  std::uint64_t first, second, resolution;
};

/// Counts picoseconds, as long as these are not too many, and else the largest part of a second
/// that both are multiples of. Throws Misuse where a count has more than 63 bits.
inline Fractions fractions_of(Duration first, Duration second = {}) {
  constexpr Duration kSecond = std::chrono::seconds(1);
  constexpr Duration kLong = std::chrono::hours(24 * 100);
  const bool is_long = first > kLong || second > kLong;
  const Duration part =
      is_long ? common_divisor(common_divisor(kSecond, first), second) : Duration(1);
  constexpr Picoseconds kMost = std::numeric_limits<std::int64_t>::max();
  if (first / part > kMost || second / part > kMost) {
    throw Misuse("the interval of " + decimal_seconds(std::max(first, second)) +
                 " s is no fraction of 64-bit numbers; ask for the decimal");
  }
  return {static_cast<std::uint64_t>(first / part), static_cast<std::uint64_t>(second / part),
          static_cast<std::uint64_t>(kSecond / part)};
}

}  // namespace stride::kit

#endif
