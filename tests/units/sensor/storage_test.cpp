#include "units/sensor/storage.h"

#include <cmath>

#include <catch2/catch.hpp>

using sensor::Storage;

TEST_CASE("energy, voltage and charge of a capacitor agree") {
  const Storage storage(100e-6, 10e6);
  CHECK(storage.energy(3.0) == Approx(450e-6));
  CHECK(storage.voltage(450e-6) == Approx(3.0));
  CHECK(storage.charge(450e-6) == Approx(300e-6));
  CHECK(storage.leakage(450e-6) == Approx(3.0 * 3.0 / 10e6));
}

TEST_CASE("the closed form agrees with many small Euler steps") {
  const Storage storage(100e-6, 5e3);
  const double power = 1.3e-3;
  double energy = 40e-6;
  const int steps = 1'000'000;
  const double size = 0.7 / steps;
  for (int i = 0; i < steps; ++i) energy += (power - storage.leakage(energy)) * size;
  CHECK(storage.after(40e-6, power, 0.7) == Approx(energy).epsilon(1e-6));
}

TEST_CASE("without a self-discharge worth the name energy grows linearly") {
  const Storage storage(100e-6, 1e18);
  CHECK(storage.after(100e-6, 2e-3, 0.25) == Approx(600e-6).epsilon(1e-12));
  CHECK(storage.time_to(100e-6, 600e-6, 2e-3) == Approx(0.25).epsilon(1e-12));
  CHECK(storage.time_to(600e-6, 100e-6, -2e-3) == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("time_to is the inverse of after") {
  const Storage storage(47e-6, 2e4);
  for (const double power : {-3e-3, -1e-4, 1e-4, 3e-3}) {
    const double end = storage.after(200e-6, power, 0.031);
    CAPTURE(power);
    CHECK(storage.time_to(200e-6, end, power) == Approx(0.031).epsilon(1e-9));
  }
}

TEST_CASE("a level behind the equilibrium is never reached") {
  const Storage storage(100e-6, 1e4);  // 1 mW holds 0.5 mJ
  CHECK(std::isinf(storage.time_to(100e-6, 501e-6, 1e-3)));
  CHECK(std::isfinite(storage.time_to(100e-6, 499e-6, 1e-3)));
  CHECK(std::isinf(storage.time_to(900e-6, 499e-6, 1e-3)));
  CHECK(std::isinf(storage.time_to(100e-6, 50e-6, 1e-3)));
}
