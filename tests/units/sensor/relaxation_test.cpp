#include "units/sensor/relaxation.h"

#include <cmath>

#include <catch2/catch.hpp>

using sensor::Relaxation;

namespace {

struct Integrals {
  double of_value, of_square;
};

/// By Simpson's rule on the closed form of the value.
Integrals simpson(const Relaxation& law, double start, double seconds) {
  constexpr int kIntervals = 20'000;
  const double h = seconds / kIntervals;
  Integrals sum{0, 0};
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2;
    const double value = law.after(start, i * h);
    sum.of_value += weight * value;
    sum.of_square += weight * value * value;
  }
  return {sum.of_value * h / 3, sum.of_square * h / 3};
}

}  // namespace

TEST_CASE("the closed form agrees with many small Euler steps") {
  const Relaxation law{1.3, 0.8};
  double x = 0.4;
  const int steps = 1'000'000;
  const double size = 0.7 / steps;
  for (int i = 0; i < steps; ++i) x += law.slope(x) * size;
  CHECK(law.after(0.4, 0.7) == Approx(x).epsilon(1e-6));
}

TEST_CASE("the integrals agree with quadrature, on both sides of the change of formula") {
  for (const double rate_times_time : {1e-9, 1e-3, 0.1, 0.499, 0.501, 2.0, 9.0, 40.0}) {
    for (const double start : {0.0, 0.3, 5.0}) {
      for (const double drift : {-1.0, 0.0, 2.5}) {
        const double seconds = 0.7;
        const Relaxation law{drift, rate_times_time / seconds};
        const Integrals expected = simpson(law, start, seconds);
        CAPTURE(rate_times_time, start, drift);
        CHECK(law.integral(start, seconds) == Approx(expected.of_value).epsilon(1e-10));
        CHECK(law.integral_of_square(start, seconds) == Approx(expected.of_square).epsilon(1e-10));
      }
    }
  }
}

TEST_CASE("the integrals are additive to rounding, however the time is divided") {
  const Relaxation law{2.0, 0.9};
  const double start = 0.2;
  for (double first = 0.05; first < 3; first += 0.05) {
    const double middle = law.after(start, first);
    const double rest = 3 - first;
    CHECK(law.integral(start, first) + law.integral(middle, rest) ==
          Approx(law.integral(start, 3)).epsilon(1e-14));
    CHECK(law.integral_of_square(start, first) + law.integral_of_square(middle, rest) ==
          Approx(law.integral_of_square(start, 3)).epsilon(1e-14));
  }
}

TEST_CASE("with a rate of almost nothing it is a straight line, to all digits") {
  const Relaxation law{2e-3, 1e-20};
  CHECK(law.after(1.0, 0.25) == Approx(1.0005).epsilon(1e-15));
  CHECK(law.time_to(1.0, 1.0005) == Approx(0.25).epsilon(1e-11));
  CHECK(law.time_to(1.0005, 1.0) == INFINITY);
  CHECK(Relaxation{-2e-3, 1e-20}.time_to(1.0005, 1.0) == Approx(0.25).epsilon(1e-11));
  CHECK(law.integral(1.0, 0.25) == Approx(0.25 + 1e-3 * 0.0625).epsilon(1e-15));
}

TEST_CASE("time_to is the inverse of after") {
  for (const double drift : {-3.0, -0.1, 0.1, 3.0}) {
    const Relaxation law{drift, 1.7};
    const double end = law.after(0.9, 0.31);
    CAPTURE(drift);
    CHECK(law.time_to(0.9, end) == Approx(0.31).epsilon(1e-12));
  }
}

TEST_CASE("a level behind the equilibrium is never reached") {
  const Relaxation law{1.0, 2.0};  // towards 0.5
  CHECK(std::isinf(law.time_to(0.1, 0.501)));
  CHECK(std::isfinite(law.time_to(0.1, 0.499)));
  CHECK(std::isinf(law.time_to(0.9, 0.499)));
  CHECK(std::isinf(law.time_to(0.1, 0.05)));
  CHECK(law.time_to(0.1, 0.1) == 0);
}
