#include "master/base/saturated_sum.h"

#include <cstdint>
#include <limits>

#include <catch2/catch.hpp>

using stride::core::saturated_sum;

TEST_CASE("a sum that has no room is the greatest number") {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  CHECK(saturated_sum(2, 3) == 5);
  CHECK(saturated_sum(kMost, 0) == kMost);
  CHECK(saturated_sum(kMost - 1, 1) == kMost);
  CHECK(saturated_sum(2, kMost - 1) == kMost);
  CHECK(saturated_sum(kMost, kMost) == kMost);
}
