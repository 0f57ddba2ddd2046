#include "units/nfc_channel/link.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace nfc_channel;

TEST_CASE("Loosely coupled, the efficiency is a quarter of U squared") {
  for (const double k : {1e-3, 1e-5}) {
    const double u = k * std::sqrt(20.0 * 45.0);
    CHECK(link_efficiency(k, 20.0, 45.0) == Approx(u * u / 4.0).epsilon(u * u));
  }
  CHECK(link_efficiency(0.0, 20.0, 45.0) == 0.0);
}

TEST_CASE("Tightly coupled, the efficiency comes near to one as 1 - 2/U") {
  CHECK(link_efficiency(1.0, 1e4, 1e4) == Approx(1.0 - 2e-4).epsilon(1e-7));
  CHECK(link_efficiency(1.0, 1e9, 1e9) < 1.0);
}

TEST_CASE("The efficiency is what the best load gets") {
  // a load that adds x times the tag's own losses gets U^2 x / ((1 + x) (1 + x + U^2))
  const double u_squared = 0.05 * 0.05 * 30.0 * 40.0;
  double best = 0.0;
  for (int i = 1; i <= 100'000; ++i) {
    const double x = i * 1e-4;
    best = std::max(best, u_squared * x / ((1.0 + x) * (1.0 + x + u_squared)));
  }
  CHECK(link_efficiency(0.05, 30.0, 40.0) == Approx(best).epsilon(1e-7));
}

TEST_CASE("Thermal noise and interference add up") {
  const double thermal = 1.380649e-23 * 290.0 * 106e3;
  CHECK(signal_to_noise(1e-12, {290.0, 0.0}, 106e3) == Approx(1e-12 / thermal));
  CHECK(signal_to_noise(1e-12, {0.0, 1e-14}, 106e3) == Approx(100.0));
  CHECK(signal_to_noise(1e-12, {290.0, 1e-14}, 106e3) == Approx(1e-12 / (thermal + 1e-14)));
  CHECK(signal_to_noise(1e-12, {290.0, 0.0}, 848e3) == Approx(1e-12 / (8.0 * thermal)));
  CHECK(signal_to_noise(0.0, {290.0, 0.0}, 106e3) == 0.0);
  CHECK(std::isinf(signal_to_noise(1e-12, {0.0, 0.0}, 106e3)));
}

TEST_CASE("Decibels stay finite") {
  CHECK(decibels(100.0) == Approx(20.0));
  CHECK(decibels(0.5) == Approx(-3.0103));
  CHECK(decibels(0.0) == -200.0);
  CHECK(decibels(std::numeric_limits<double>::infinity()) == 200.0);
}

TEST_CASE("The bit error probability falls from one half") {
  CHECK(bit_error_probability(0.0) == 0.5);
  CHECK(bit_error_probability(std::numeric_limits<double>::infinity()) == 0.0);
  // noncoherent detection of orthogonal signals at Eb/N0 = 12 dB
  CHECK(bit_error_probability(std::pow(10.0, 1.2)) == Approx(1.8089e-4).epsilon(1e-3));
}
