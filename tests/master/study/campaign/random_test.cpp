#include "master/study/campaign/random.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "master/base/files/sha256.h"

using stride::campaign::RandomStream;

TEST_CASE("the numbers are what they were when plans were made with them") {
  const RandomStream stream(7, "case");
  CHECK(stream.bits(0) == 11149526395226619500U);
  CHECK(stream.bits(1) == 3967884150368284806U);
  CHECK(RandomStream(8, "case").bits(0) != stream.bits(0));
  CHECK(RandomStream(7, "other").bits(0) != stream.bits(0));
}

TEST_CASE("uniform numbers are within the unit interval, and spread") {
  const RandomStream stream(1, "uniform");
  double sum = 0, squares = 0;
  constexpr int kCount = 100'000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double u = stream.uniform(i);
    REQUIRE((u > 0 && u < 1));
    sum += u;
    squares += u * u;
  }
  CHECK(sum / kCount == Approx(0.5).margin(0.003));
  CHECK(squares / kCount == Approx(1.0 / 3).margin(0.003));
}

TEST_CASE("permutations are ones, of any count") {
  const RandomStream stream(2, "permutation");
  for (const std::uint64_t count : {1, 2, 3, 5, 7, 16, 17, 255, 256, 257, 1000, 5000}) {
    CAPTURE(count);
    std::vector<bool> taken(count);
    std::uint64_t kept = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t place = stream.permuted(i, count);
      REQUIRE(place < count);
      REQUIRE_FALSE(taken[place]);
      taken[place] = true;
      kept += place == i;
    }
    if (count > 200) CHECK(kept < 10);  // 1 on average
  }
}

TEST_CASE("each permutation of few places comes equally often") {
  std::vector<double> counts(27);
  constexpr int kCount = 6000;
  for (int seed = 0; seed < kCount; ++seed) {
    const RandomStream stream(static_cast<std::uint64_t>(seed), "x");
    counts[9 * stream.permuted(0, 3) + 3 * stream.permuted(1, 3) + stream.permuted(2, 3)] += 1;
  }
  int permutations = 0;
  for (const double count : counts) {
    if (count == 0) continue;
    ++permutations;
    CHECK(std::abs(count - 1000) < 130);
  }
  CHECK(permutations == 6);
}
