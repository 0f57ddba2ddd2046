#include "master/study/search/shrink.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace stride::search;

namespace {

constexpr double kTolerance = 0.001;

}  // namespace

TEST_CASE("of a failure by one parameter only that one is left, at its boundary") {
  int runs = 0;
  const Shrunk shrunk = shrink({true, true, true}, kTolerance, [&](const Shares& shares) {
    ++runs;
    return shares[1] > 0.3;
  });
  CHECK(shrunk.failing[0] == 0);
  CHECK(shrunk.failing[2] == 0);
  CHECK(shrunk.failing[1] > 0.3);
  CHECK(shrunk.failing[1] < 0.3 + kTolerance);
  REQUIRE(shrunk.passing[1]);
  CHECK(*shrunk.passing[1] <= 0.3);
  CHECK_FALSE(shrunk.passing[0]);
  CHECK(runs < 25);
}

TEST_CASE("a boundary is that of a dense scan") {
  for (int number = 0; number < 20; ++number) {
    const double tilt = 0.2 + 0.03 * number, offset = 0.9 - 0.02 * number;
    const auto fails = [&](const Shares& shares) {
      return shares[0] * tilt + shares[1] * offset > 0.7 && shares[2] == 1;
    };
    if (!fails({1, 1, 1})) continue;
    CAPTURE(number);
    const Shrunk shrunk = shrink({true, true, false}, kTolerance, fails);
    CHECK(fails(shrunk.failing));
    CHECK(shrunk.failing[2] == 1);
    CHECK_FALSE(shrunk.passing[2]);
    for (int i = 0; i < 2; ++i) {
      if (shrunk.failing[i] == 0) continue;
      Shares scanned = shrunk.failing;
      double boundary = 1;
      for (int step = 1000; step >= 0; --step) {
        scanned[i] = shrunk.failing[i] * step / 1000;
        if (!fails(scanned)) break;
        boundary = scanned[i];
      }
      CHECK(shrunk.failing[i] == Approx(boundary).margin(2 * kTolerance));
      scanned[i] = *shrunk.passing[i];
      CHECK_FALSE(fails(scanned));
    }
  }
}

TEST_CASE("a failure that needs all of its parameters keeps them") {
  const Shrunk shrunk = shrink({true, false}, kTolerance, [](const Shares& shares) {
    return shares[0] > 0.5 && shares[1] == 1;
  });
  CHECK(shrunk.failing[0] == Approx(0.5).margin(kTolerance));
  CHECK(shrunk.failing[1] == 1);
}

TEST_CASE("a failure of the nominal case is left without parameters") {
  const Shrunk shrunk = shrink({true, true}, kTolerance, [](const Shares&) { return true; });
  CHECK(shrunk.failing == Shares{0, 0});
}

TEST_CASE("a failure that comes and goes ends at one of its boundaries") {
  const auto fails = [](const Shares& shares) {
    return std::fmod(shares[0] * 5, 1) > 0.5 || shares[0] == 1;
  };
  const Shrunk shrunk = shrink({true}, kTolerance, fails);
  CHECK(fails(shrunk.failing));
  CHECK_FALSE(fails({*shrunk.passing[0]}));
  CHECK(shrunk.failing[0] - *shrunk.passing[0] <= kTolerance);
}
