// Free space, the ground's reflection and both rays together, against closed forms and published
// values.
#include "units/rf_channel/propagation.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace rf_channel;
using Eigen::Vector3d;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFrequency = 2.45e9;
constexpr double kWavelength = kSpeedOfLight / kFrequency;

Ground nowhere() {
  Ground ground;
  ground.reflects = false;
  return ground;
}

/// As good a conductor as numbers allow.
Ground metal() {
  Ground ground;
  ground.permittivity = 1.0;
  ground.conductivity = 1e20;
  return ground;
}

Pose at(double x, double z, const Vector3d& axis = Vector3d::UnitZ()) { return {{x, 0, z}, axis}; }

double decibels(double ratio) { return 10.0 * std::log10(ratio); }

double sine(double degrees) { return std::sin(degrees * kPi / 180.0); }

/// Without vectors, as textbooks have it.
double two_rays(double distance, double h1, double h2, std::complex<double> reflection) {
  const double d1 = std::hypot(distance, h1 - h2);
  const double d2 = std::hypot(distance, h1 + h2);
  const double k = 2.0 * kPi / kWavelength;
  const auto field = std::polar(1.0 / d1, -k * d1) + reflection * std::polar(1.0 / d2, -k * d2);
  return std::norm(field * kWavelength / (4.0 * kPi));
}

}  // namespace

TEST_CASE(
    "In free space Friis' loss is 40.2 dB at one metre and 2.45 GHz, and 6 dB more per double") {
  // 32.45 + 20 log (d / km) + 20 log (f / MHz), ITU-R P.525
  const double at_1_m =
      path_gain(at(0, 5), at(1, 5), {Antenna::IsotropicVertical, 1.0, nowhere(), kFrequency});
  CHECK(-decibels(at_1_m) == Approx(32.45 - 60.0 + 20.0 * std::log10(2450.0)).margin(0.01));
  const double at_2_m =
      path_gain(at(0, 5), at(2, 5), {Antenna::IsotropicVertical, 4.0, nowhere(), kFrequency});
  CHECK(at_2_m == Approx(at_1_m));  // four times the gain
}

TEST_CASE("Near by, no more is received than was sent") {
  for (const double distance : {0.0, 1e-6, 0.001, 0.01}) {
    CHECK(path_gain(at(0, 5), at(distance, 5),
                    {Antenna::IsotropicVertical, 1.0, nowhere(), kFrequency}) == Approx(0.25));
    CHECK(path_gain(at(0, 5), at(distance, 5),
                    {Antenna::IsotropicVertical, 1000.0, metal(), kFrequency}) == 1.0);
  }
}

TEST_CASE("Fresnel: grazing, straight down, and no reflection at Brewster's angle") {
  Ground glass;
  glass.permittivity = 15.0;
  glass.conductivity = 0.0;
  const auto grazing = reflection(glass, 1e-6, kFrequency);
  CHECK(std::abs(grazing.vertical + 1.0) < 1e-4);
  CHECK(std::abs(grazing.horizontal + 1.0) < 1e-4);
  const auto down = reflection(glass, 1.0, kFrequency);
  const double n = std::sqrt(15.0);
  CHECK(down.horizontal.real() == Approx((1.0 - n) / (1.0 + n)));
  CHECK(down.vertical.real() == Approx((n - 1.0) / (n + 1.0)));
  // sin psi = 1 / sqrt(1 + e_r): Rappaport, eq. 4.27; 14.48 degrees for e_r = 15
  CHECK(std::abs(reflection(glass, 0.25, kFrequency).vertical) < 1e-12);
  CHECK(std::abs(reflection(glass, sine(14.48), kFrequency).vertical) < 1e-3);
}

TEST_CASE("Fresnel: over average ground as published") {
  // J.-P. Linnartz, "Wireless Communication Reference", plane earth loss: horizontal above 0.9 for
  // less than 10 degrees; vertical above 0.5 for less than 5 and above 0.9 for less than 1 degree
  const Ground average;  // e_r 15, 5 mS/m
  for (const double degrees : {0.1, 1.0, 5.0, 9.0}) {
    CHECK(std::abs(reflection(average, sine(degrees), 900e6).horizontal) > 0.9 - 0.02);
  }
  CHECK(std::abs(reflection(average, sine(4.5), 900e6).vertical) > 0.5);
  CHECK(std::abs(reflection(average, sine(0.7), 900e6).vertical) > 0.9);
}

TEST_CASE("A conductor reflects all, the horizontal field turned round") {
  for (const double degrees : {5.0, 30.0, 85.0}) {
    const auto whole = reflection(metal(), sine(degrees), kFrequency);
    CHECK(std::abs(whole.vertical - 1.0) < 1e-6);
    CHECK(std::abs(whole.horizontal + 1.0) < 1e-6);
  }
}

TEST_CASE("Isotropic antennas get the textbook's two rays") {
  const Ground ground;
  for (const double distance : {0.3, 0.7, 2.0, 50.0}) {
    const double h1 = 0.4, h2 = 0.15;
    const auto r = reflection(ground, (h1 + h2) / std::hypot(distance, h1 + h2), kFrequency);
    CHECK(path_gain(at(0, h1), at(distance, h2),
                    {Antenna::IsotropicVertical, 1.0, ground, kFrequency}) ==
          Approx(two_rays(distance, h1, h2, r.vertical)));
    CHECK(path_gain(at(0, h1), at(distance, h2),
                    {Antenna::IsotropicHorizontal, 1.0, ground, kFrequency}) ==
          Approx(two_rays(distance, h1, h2, r.horizontal)));
  }
}

TEST_CASE("A ground at another height is the same as antennas at another height") {
  Ground low;
  low.height = -3.0;
  const Ground ground;
  CHECK(path_gain(at(0, -2.6), at(1, -2.9), {Antenna::Dipole, 1.0, low, kFrequency}) ==
        Approx(path_gain(at(0, 0.4), at(1, 0.1), {Antenna::Dipole, 1.0, ground, kFrequency})));
}

TEST_CASE("Far away the loss is 40 log d - 20 log h1 h2, whatever the frequency") {
  // Rappaport, eq. 4.53; Parsons, eq. 2.24
  const double h1 = 15.0, h2 = 20.0, distance = 200e3;
  const double expected = 40.0 * std::log10(distance) - 20.0 * std::log10(h1 * h2);
  for (const double frequency : {433e6, 868e6, 2.45e9}) {
    for (const Antenna antenna : {Antenna::IsotropicHorizontal, Antenna::IsotropicVertical}) {
      // a vertical field takes far longer to get there, over a conductor it never does
      Ground ground;
      ground.conductivity = 0.0;
      if (antenna == Antenna::IsotropicVertical) ground.permittivity = 2.0;
      const double gain = path_gain(at(0, h1), at(distance, h2), {antenna, 1.0, ground, frequency});
      CHECK(-decibels(gain) == Approx(expected).margin(0.1));
    }
  }
}

TEST_CASE("The received power of Rappaport's example 4.6") {
  // 1 mV/m at 1 km in free space, 900 MHz, heights 50 m and 1.5 m, 5 km: 113.1 uV/m by the
  // approximation for far away, and 5.4e-13 W in an antenna of gain 1.8. Here both rays are exact,
  // which makes 1.3 % less of the field.
  const double sent = std::pow(1e-3 * 1e3, 2) / 30.0;  // E^2 d^2 / 30 Ohm [W], times its gain
  const double received = sent * path_gain(at(0, 50), at(5000, 1.5),
                                           {Antenna::IsotropicHorizontal, 1.8, metal(), 900e6});
  CHECK(received == Approx(5.4e-13).epsilon(0.04));
}

TEST_CASE("The last maximum is at the break point, where the paths differ by half a wave") {
  // 4 h1 h2 / lambda: Parsons, section 2.3.2; Molisch, "Wireless Communications", section 4.2
  const double h1 = 1.0, h2 = 2.0;
  const double break_point = 4.0 * h1 * h2 / kWavelength;
  const auto gain = [&](double distance) {
    return path_gain(at(0, h1), at(distance, h2),
                     {Antenna::IsotropicHorizontal, 1.0, metal(), kFrequency}) /
           path_gain(at(0, h1), at(distance, h2),
                     {Antenna::IsotropicHorizontal, 1.0, nowhere(), kFrequency});
  };
  CHECK(gain(break_point) == Approx(4.0).epsilon(1e-3));
  CHECK(gain(2.0 * break_point) == Approx(2.0).epsilon(1e-3));
  CHECK(gain(0.5 * break_point) < 1e-3);  // a whole wave: they cancel
  for (double distance = break_point; distance < 10.0 * break_point; distance *= 1.1) {
    CHECK(gain(1.1 * distance) < gain(distance) + 1e-9);
  }
}

TEST_CASE("A dipole has sin theta of the field, and the best direction all of the gain") {
  const auto gain = [](const Vector3d& first, const Vector3d& second) {
    return path_gain(at(0, 5, first), at(3, 5, second),
                     {Antenna::Dipole, 1.5 * 1.5, nowhere(), kFrequency});
  };
  const double best = gain(Vector3d::UnitZ(), Vector3d::UnitZ());
  CHECK(best == Approx(2.25 * std::pow(kWavelength / (4.0 * kPi * 3.0), 2)));
  CHECK(gain(2.0 * Vector3d::UnitZ(), -7.0 * Vector3d::UnitZ()) == Approx(best));
  for (const double theta : {10.0, 45.0, 70.0}) {
    const Vector3d tilted{std::cos(theta * kPi / 180.0), 0.0, sine(theta)};
    CHECK(gain(tilted, Vector3d::UnitZ()) == Approx(best * std::pow(sine(theta), 2)));
  }
  CHECK(gain(Vector3d::UnitX(), Vector3d::UnitZ()) < 1e-30);  // end on
  CHECK(gain(Vector3d::UnitY(), Vector3d::UnitZ()) < 1e-30);  // cross polarised
}

TEST_CASE("Over a conductor a dipole gets what its image sends, in any pose") {
  // the image of a vertical dipole stands as it does, that of a horizontal one is turned round
  // (Balanis, "Antenna Theory", 4th ed., section 4.7)
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto random = [&] { return Vector3d(any(generator), any(generator), any(generator)); };
  const auto ray = [](const Vector3d& from, const Vector3d& a, const Vector3d& to,
                      const Vector3d& b) {
    const Vector3d u = (to - from).normalized();
    const double d = (to - from).norm();
    return (a.dot(b) - a.dot(u) * b.dot(u)) * std::polar(1.0 / d, -2.0 * kPi * d / kWavelength);
  };
  for (int i = 0; i < 200; ++i) {
    const Pose first{random() + Vector3d(0, 0, 1.1), random().normalized()};
    const Pose second{random() + Vector3d(2.5, 0, 1.1), random().normalized()};
    const Vector3d image = first.position.cwiseProduct(Vector3d(1, 1, -1));
    const Vector3d axis = first.axis.cwiseProduct(Vector3d(-1, -1, 1));
    const double expected =
        std::norm(kWavelength / (4.0 * kPi) *
                  (ray(first.position, first.axis, second.position, second.axis) +
                   ray(image, axis, second.position, second.axis)));
    const double gain = path_gain(first, second, {Antenna::Dipole, 1.0, metal(), kFrequency});
    CHECK(gain == Approx(expected).epsilon(1e-5).margin(1e-12));
  }
}

TEST_CASE("The way back is as good as the way there, in any pose over any ground") {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto random = [&] { return Vector3d(any(generator), any(generator), any(generator)); };
  for (int i = 0; i < 300; ++i) {
    const Pose first{random() + Vector3d(0, 0, 1.1), random()};
    const Pose second{random() + Vector3d(0, 0, 1.1), random()};
    const auto antenna = static_cast<Antenna>(i % 3);
    CHECK(path_gain(first, second, {antenna, 1.0, Ground(), kFrequency}) ==
          Approx(path_gain(second, first, {antenna, 1.0, Ground(), kFrequency})).margin(1e-15));
  }
}

TEST_CASE(
    "Straight above each other dipoles get nothing, and what lies flat gets the ground's echo") {
  const Ground ground;
  CHECK(path_gain(at(0, 0.1), at(0, 0.5), {Antenna::Dipole, 1.0, ground, kFrequency}) < 1e-30);
  const double flat = path_gain(at(0, 0.1, Vector3d::UnitX()), at(0, 0.5, Vector3d::UnitX()),
                                {Antenna::Dipole, 1.0, ground, kFrequency});
  const auto r = reflection(ground, 1.0, kFrequency);
  CHECK(flat == Approx(two_rays(0.0, 0.1, 0.5, r.horizontal)));
}

TEST_CASE("Below a ground that reflects nothing is heard") {
  CHECK(path_gain(at(0, -0.1), at(1, 0.5), {Antenna::Dipole, 1.0, Ground(), kFrequency}) == 0.0);
  CHECK(path_gain(at(0, 0.1), at(1, -0.5), {Antenna::Dipole, 1.0, Ground(), kFrequency}) == 0.0);
  CHECK(path_gain(at(0, -0.1), at(1, 0.5), {Antenna::Dipole, 1.0, nowhere(), kFrequency}) > 0.0);
}
