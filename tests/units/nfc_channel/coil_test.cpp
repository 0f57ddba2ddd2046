#include "units/nfc_channel/coil.h"

#include <cmath>

#include <catch2/catch.hpp>

using nfc_channel::coaxial_mutual_inductance;
using nfc_channel::Coil;
using nfc_channel::coupling_factor;
using nfc_channel::inductance;
using nfc_channel::kVacuumPermeability;
using nfc_channel::Pose;

namespace {

constexpr double kPi = 3.14159265358979323846;

const Coil kReader{0.030, 4, 0.5e-3, 0.0, 10.0};
const Coil kTag{0.015, 8, 0.1e-3, 0.0, 10.0};

Pose along_z(double distance) { return {{0.0, 0.0, distance}, {0.0, 0.0, 1.0}}; }

// Neumann's double line integral, which by symmetry is a single one, summed by the midpoint rule.
double neumann(const Coil& first, const Coil& second, double distance) {
  constexpr int kPoints = 20'000;
  const double a = first.radius;
  const double b = second.radius;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * kPi * (i + 0.5) / kPoints;
    sum += std::cos(angle) /
           std::sqrt(a * a + b * b + distance * distance - 2.0 * a * b * std::cos(angle));
  }
  return kVacuumPermeability / 2.0 * first.turns * second.turns * a * b * sum * 2.0 * kPi / kPoints;
}

}  // namespace

TEST_CASE("Mutual inductance agrees with a worked example of Grover's") {
  // "Inductance Calculations": radii of 25 and 20 cm, 10 cm apart, one turn each
  const Coil large{0.25, 1, 1e-3, 0.0, 1.0};
  const Coil small{0.20, 1, 1e-3, 0.0, 1.0};
  CHECK(coaxial_mutual_inductance(large, small, 0.10) == Approx(0.24879e-6).epsilon(1e-4));
}

TEST_CASE("Mutual inductance agrees with Neumann's integral, near and far") {
  for (const double distance : {0.002, 0.01, 0.03, 0.04, 0.1, 0.3, 1.0, 1.4, 1.5, 3.0}) {
    CHECK(coaxial_mutual_inductance(kReader, kTag, distance) ==
          Approx(neumann(kReader, kTag, distance)).epsilon(1e-7));
  }
}

TEST_CASE("Far away the coils are dipoles") {
  for (const double d : {3.0, 30.0, 3000.0}) {
    const double a = kReader.radius;
    const double b = kTag.radius;
    const double dipole =
        kVacuumPermeability * kPi * kReader.turns * kTag.turns * a * a * b * b / (2.0 * d * d * d);
    CHECK(coaxial_mutual_inductance(kReader, kTag, d) == Approx(dipole).epsilon(0.01 / (d * d)));
  }
}

TEST_CASE("Mutual inductance is symmetric, even and falls with the distance") {
  double last = coaxial_mutual_inductance(kReader, kTag, 0.0);
  for (int mm = 1; mm <= 5000; ++mm) {
    const double d = mm * 1e-3;
    const double mutual = coaxial_mutual_inductance(kReader, kTag, d);
    CHECK(mutual > 0.0);
    CHECK(mutual < last + (mm == 1 ? 1e-15 : 0.0));
    last = mutual;
  }
  CHECK(coaxial_mutual_inductance(kReader, kTag, 0.04) ==
        Approx(coaxial_mutual_inductance(kTag, kReader, 0.04)).epsilon(1e-14));
  CHECK(coaxial_mutual_inductance(kReader, kTag, -0.04) ==
        coaxial_mutual_inductance(kReader, kTag, 0.04));
}

TEST_CASE("A coil is its own mutual inductance at the distance of its wire's radius") {
  const Coil thin{0.030, 4, 30e-6, 0.0, 10.0};
  CHECK(coaxial_mutual_inductance(thin, thin, 0.0) == Approx(inductance(thin)).epsilon(1e-4));
  CHECK(coupling_factor(thin, Pose{}, thin, Pose{}) == Approx(1.0).epsilon(1e-4));
  CHECK(coupling_factor(thin, Pose{}, thin, Pose{}) <= 1.0);
}

TEST_CASE("Inductance goes with the square of the turns, or is what the parameter says") {
  Coil coil{0.05, 1, 0.5e-3, 0.0, 10.0};
  const double one = inductance(coil);
  CHECK(one == Approx(4e-7 * kPi * 0.05 * (std::log(800.0) - 2.0)).epsilon(1e-6));
  coil.turns = 3;
  CHECK(inductance(coil) == Approx(9.0 * one));
  coil.inductance = 1.5e-6;
  CHECK(inductance(coil) == 1.5e-6);
}

TEST_CASE("The coupling factor does not depend on the numbers of turns") {
  Coil reader = kReader;
  reader.turns = 1;
  CHECK(coupling_factor(reader, Pose{}, kTag, along_z(0.04)) ==
        Approx(coupling_factor(kReader, Pose{}, kTag, along_z(0.04))));
}

TEST_CASE("A tilted coil couples with the cosine of the angle, whichever way its normal points") {
  const double coaxial = coupling_factor(kReader, Pose{}, kTag, along_z(0.04));
  const auto tilted = [](double degrees, double length) {
    Pose pose = along_z(0.04);
    const double angle = degrees * kPi / 180.0;
    pose.axis = length * Eigen::Vector3d(0.0, std::sin(angle), std::cos(angle));
    return coupling_factor(kReader, Pose{}, kTag, pose);
  };
  CHECK(tilted(60, 1.0) == Approx(coaxial / 2.0));
  CHECK(tilted(60, 7.0) == Approx(coaxial / 2.0));
  CHECK(tilted(180, 1.0) == Approx(coaxial));
  CHECK(tilted(90, 1.0) == Approx(0.0).margin(1e-15));
}

TEST_CASE("Only where the coils are to each other matters") {
  Pose reader{{1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}};
  Pose tag{{1.0, 2.04, 3.0}, {0.0, 1.0, 0.0}};
  CHECK(coupling_factor(kReader, reader, kTag, tag) ==
        Approx(coupling_factor(kReader, Pose{}, kTag, along_z(0.04))));
}

TEST_CASE("A normal of length zero is refused") {
  Pose flat = along_z(0.04);
  flat.axis.setZero();
  CHECK_THROWS_WITH(coupling_factor(kReader, Pose{}, kTag, flat), Catch::Contains("length zero"));
}
