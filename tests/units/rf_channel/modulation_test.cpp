// Bit error rates against published values and against other ways to them.
#include "units/rf_channel/modulation.h"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace rf_channel;

namespace {

double linear(double decibels) { return std::pow(10.0, decibels / 10.0); }

double oqpsk(double decibels) { return bit_error_probability(Modulation::Oqpsk, linear(decibels)); }

double gfsk(double decibels) { return bit_error_probability(Modulation::Gfsk, linear(decibels)); }

/// Marcum's Q_1(a, b) for a < b as a series of Bessel functions (Simon and Alouini, eq. 4.15).
double marcum_q(double a, double b) {
  double sum = 0.0;
  for (int k = 0; k < 100; ++k) sum += std::pow(a / b, k) * std::cyl_bessel_i(k, a * b);
  return std::exp(-0.5 * (a * a + b * b)) * sum;
}

/// How many of two noisy correlated signals are taken for the other by their envelopes.
double simulated_fsk_error(double energy_to_noise, double correlation, int count) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0.0, std::sqrt(0.5));
  const double amplitude = std::sqrt(energy_to_noise);
  const double rest = std::sqrt(1.0 - correlation * correlation);
  int wrong = 0;
  for (int i = 0; i < count; ++i) {
    const double n[] = {normal(generator), normal(generator), normal(generator), normal(generator)};
    const double right = std::hypot(amplitude + n[0], n[1]);
    const double other = std::hypot(correlation * (amplitude + n[0]) + rest * n[2],
                                    correlation * n[1] + rest * n[3]);
    wrong += other > right ? 1 : 0;
  }
  return static_cast<double>(wrong) / count;
}

}  // namespace

TEST_CASE("O-QPSK: the published values of IEEE 802.15.4's formula") {
  // as in the tests of ns-3's lr-wpan model, which follow figure E.2 of IEEE Std 802.15.4-2006
  CHECK(oqpsk(5) == Approx(7.38e-14).margin(0.01e-14));
  CHECK(oqpsk(2) == Approx(5.13e-7).margin(0.01e-7));
  CHECK(oqpsk(-1) == Approx(0.00114).margin(0.00001));
  CHECK(oqpsk(-4) == Approx(0.0391).margin(0.0001));
  CHECK(oqpsk(-7) == Approx(0.175).margin(0.001));
}

TEST_CASE("O-QPSK: it is 16 orthogonal signals distinguished by their envelopes") {
  // Proakis and Salehi, section 4.5-2: the error of a symbol by simulation, 8 of 15 for a bit
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(0.0, std::sqrt(0.5));
  for (const double ratio : {0.15, 0.35}) {
    const double amplitude = std::sqrt(20.0 * ratio);
    constexpr int kCount = 40'000;
    int wrong = 0;
    for (int i = 0; i < kCount; ++i) {
      const double right = std::hypot(amplitude + normal(generator), normal(generator));
      bool is_wrong = false;
      for (int other = 0; other < 15; ++other) {
        is_wrong |= std::hypot(normal(generator), normal(generator)) > right;
      }
      wrong += is_wrong ? 1 : 0;
    }
    const double expected = 15.0 / 8.0 * bit_error_probability(Modulation::Oqpsk, ratio);
    CHECK(static_cast<double>(wrong) / kCount ==
          Approx(expected).margin(5.0 * std::sqrt(expected / kCount)));
  }
}

TEST_CASE("Correlated FSK: without correlation it is 1/2 exp(-x / 2), the well-known formula") {
  for (const double x : {0.0, 0.5, 3.0, 12.0, 40.0, 200.0}) {
    CHECK(correlated_fsk_error(x, 0.0) == Approx(0.5 * std::exp(-0.5 * x)).epsilon(1e-12));
  }
}

TEST_CASE("Correlated FSK: the integral is Q_1(a, b) - 1/2 exp(...) I_0(a b)") {
  for (const double correlation : {0.2, 2.0 / 3.14159265358979, 0.9}) {
    for (const double x : {0.7, 4.0, 15.0, 30.0}) {
      const double root = std::sqrt(1.0 - correlation * correlation);
      const double a = std::sqrt(0.5 * x * (1.0 - root));
      const double b = std::sqrt(0.5 * x * (1.0 + root));
      const double expected =
          marcum_q(a, b) - 0.5 * std::exp(-0.5 * (a * a + b * b)) * std::cyl_bessel_i(0, a * b);
      CHECK(correlated_fsk_error(x, correlation) == Approx(expected).epsilon(1e-9));
    }
  }
}

TEST_CASE("Correlated FSK: as many errors as a simulation has") {
  constexpr int kCount = 200'000;
  for (const double x : {2.0, 6.0}) {
    const double expected = correlated_fsk_error(x, 0.6366);
    CHECK(simulated_fsk_error(x, 0.6366, kCount) ==
          Approx(expected).margin(5.0 * std::sqrt(expected / kCount)));
  }
}

TEST_CASE("GFSK needs some 15 dB for one error in a thousand bits, O-QPSK less than 0 dB") {
  // Bluetooth's reference sensitivity is set for 1e-3; receivers need 12 to 17 dB of carrier to
  // noise
  CHECK(gfsk(14.0) > 1e-3);
  CHECK(gfsk(15.0) < 1e-3);
  CHECK(oqpsk(-1.0) > 1e-3);
  CHECK(oqpsk(0.0) < 1e-3);
}

TEST_CASE(
    "Without a signal every other bit is wrong, without noise none, and more signal is better") {
  for (const Modulation modulation : {Modulation::Oqpsk, Modulation::Gfsk}) {
    CHECK(bit_error_probability(modulation, 0.0) == Approx(0.5));
    CHECK(bit_error_probability(modulation, std::numeric_limits<double>::infinity()) == 0.0);
    double before = 0.5;
    for (double decibels = -60.0; decibels < 60.0; decibels += 0.1) {
      const double now = bit_error_probability(modulation, linear(decibels));
      CHECK(now >= 0.0);
      CHECK(now <= before + 1e-15);
      before = now;
    }
    CHECK(before == 0.0);
  }
}

TEST_CASE("A packet's bits are as fast as the standards say") {
  const PacketFormat& oqpsk = packet_format(Modulation::Oqpsk);
  CHECK(oqpsk.symbol / oqpsk.bits_per_symbol == stride::duration_from_seconds(1.0 / 250e3));
  CHECK(oqpsk.header == stride::duration_from_seconds(6 * 8 / 250e3));
  const PacketFormat& gfsk = packet_format(Modulation::Gfsk);
  CHECK(gfsk.symbol / gfsk.bits_per_symbol == stride::duration_from_seconds(1.0 / 1e6));
  CHECK(gfsk.header == stride::duration_from_seconds(7 * 8 / 1e6));
}
