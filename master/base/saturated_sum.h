#ifndef STRIDE_MASTER_BASE_SATURATED_SUM_H
#define STRIDE_MASTER_BASE_SATURATED_SUM_H

#include <algorithm>
#include <cstdint>
#include <limits>

namespace stride::core {

/// Of counts that a file may have: no more than the greatest number.
constexpr std::uint64_t saturated_sum(std::uint64_t a, std::uint64_t b) {
  return a + std::min(b, std::numeric_limits<std::uint64_t>::max() - a);
}

}  // namespace stride::core

#endif
