#include "units/nfc_channel/coil.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using nfc_channel::Coil;
using nfc_channel::coupling_factor;
using nfc_channel::field_reach;
using nfc_channel::inductance;
using nfc_channel::kVacuumPermeability;
using nfc_channel::mutual_inductance;
using nfc_channel::Pose;

namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

const Coil kReaderCoil{0.030, 4, 0.5e-3, 0.0, 10.0};
const Coil kTagCoil{0.015, 8, 0.1e-3, 0.0, 10.0};

Coil filament(double radius) { return {radius, 1, 1e-9, 0.0, 1.0}; }
Pose along_z(double distance) { return {{0.0, 0.0, distance}, {0.0, 0.0, 1.0}}; }

// Maxwell's closed form for coaxial circles, "A Treatise on Electricity and Magnetism", art. 701.
double maxwell(const Coil& first, const Coil& second, double distance) {
  const double a = first.radius;
  const double b = second.radius;
  const double q = std::sqrt(4.0 * a * b / ((a + b) * (a + b) + distance * distance));
  return kVacuumPermeability * first.turns * second.turns * std::sqrt(a * b) *
         ((2.0 / q - q) * std::comp_ellint_1(q) - 2.0 / q * std::comp_ellint_2(q));
}

// A point of a coil's centre line and its derivative by the angle. Plain numbers, for millions of
// pairs without optimisation.
struct Element {
  double x, y, z;
  double dx, dy, dz;
};

std::vector<Element> elements(const Coil& coil, const Pose& pose, int points) {
  const Vector3d n = pose.axis.normalized();
  const Vector3d u = n.unitOrthogonal();
  const Vector3d v = n.cross(u);
  std::vector<Element> found;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * kPi * i / points;
    const Vector3d p = pose.position + coil.radius * (std::cos(angle) * u + std::sin(angle) * v);
    const Vector3d dp = coil.radius * (std::cos(angle) * v - std::sin(angle) * u);
    found.push_back({p.x(), p.y(), p.z(), dp.x(), dp.y(), dp.z()});
  }
  return found;
}

// Neumann's double line integral as it stands, summed over both coils.
double neumann(const Coil& first, const Pose& first_pose, const Coil& second,
               const Pose& second_pose, int points) {
  const std::vector<Element> seconds = elements(second, second_pose, points);
  double sum = 0.0;
  for (const Element& a : elements(first, first_pose, points)) {
    for (const Element& b : seconds) {
      const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
      sum += (a.dx * b.dx + a.dy * b.dy + a.dz * b.dz) / std::sqrt(x * x + y * y + z * z);
    }
  }
  const double element = 2.0 * kPi / points;
  return kVacuumPermeability / (4.0 * kPi) * first.turns * second.turns * sum * element * element;
}

// Circles with parallel axes: mu0 pi a b times the integral of J1(sa) J1(sb) J0(sp) exp(-s|z|) ds
// (Conway, "Inductance Calculations for Noncoaxial Coils Using Bessel Functions", IEEE Trans. Magn.
// 43(3), 2007), summed by Simpson's rule.
double conway(double a, double b, double lateral, double z) {
  constexpr int kIntervals = 20'000;
  const double end = 40.0 / z;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double s = end * i / kIntervals;
    const double weight = i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * std::cyl_bessel_j(1, s * a) * std::cyl_bessel_j(1, s * b) *
           std::cyl_bessel_j(0, s * lateral) * std::exp(-s * z);
  }
  return kVacuumPermeability * kPi * a * b * sum * end / kIntervals / 3.0;
}

// The flux density of a circle of radius a in the plane z = 0, centred at the origin, for 1 A
// (W. R. Smythe, "Static and Dynamic Electricity", 3rd ed., section 7.10).
Vector3d field_of_circle(double a, const Vector3d& point) {
  const double rho = std::hypot(point.x(), point.y());
  const double z = point.z();
  const double far = (a + rho) * (a + rho) + z * z;
  const double near = (a - rho) * (a - rho) + z * z;
  const double k = std::sqrt(4.0 * a * rho / far);
  const double first = std::comp_ellint_1(k);
  const double second = std::comp_ellint_2(k);
  const double scale = kVacuumPermeability / (2.0 * kPi * std::sqrt(far));
  const double axial = scale * (first + (a * a - rho * rho - z * z) / near * second);
  if (rho < 1e-9 * a) return {0.0, 0.0, axial};
  const double radial = scale * z / rho * ((a * a + rho * rho + z * z) / near * second - first);
  return {radial * point.x() / rho, radial * point.y() / rho, axial};
}

// That field's flux through a disk, summed by Simpson's rule along the radius.
double flux(double a, double radius, const Pose& disk) {
  constexpr int kIntervals = 100;
  constexpr int kAngles = 120;
  const Vector3d n = disk.axis.normalized();
  const Vector3d u = n.unitOrthogonal();
  const Vector3d v = n.cross(u);
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double r = radius * i / kIntervals;
    const double weight = i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    for (int k = 0; k < kAngles; ++k) {
      const double angle = 2.0 * kPi * k / kAngles;
      const Vector3d point = disk.position + r * (std::cos(angle) * u + std::sin(angle) * v);
      sum += weight * r * n.dot(field_of_circle(a, point));
    }
  }
  return sum * radius / kIntervals / 3.0 * 2.0 * kPi / kAngles;
}

// The points of a coil's centre line.
std::vector<Vector3d> wire(const Coil& coil, const Pose& pose) {
  const Vector3d u = pose.axis.normalized().unitOrthogonal();
  const Vector3d v = pose.axis.normalized().cross(u);
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    const double angle = 2.0 * kPi * i / 200;
    points.push_back(pose.position + coil.radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

double gap(const std::vector<Vector3d>& first, const std::vector<Vector3d>& second) {
  double least = HUGE_VAL;
  for (const Vector3d& p : first) {
    for (const Vector3d& r : second) least = std::min(least, (r - p).norm());
  }
  return least;
}

Vector3d random_vector(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector3d v;
  do {
    v = Vector3d(uniform(generator), uniform(generator), uniform(generator));
  } while (v.norm() < 0.1 || v.norm() > 1.0);
  return v;
}

}  // namespace

TEST_CASE("Coaxial coils: Maxwell's closed form, near and far") {
  for (const double d : {0.0, 0.002, 0.01, 0.03, 0.04, 0.1, 0.3}) {
    CHECK(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, along_z(d)) ==
          Approx(maxwell(kReaderCoil, kTagCoil, d)).epsilon(1e-9));
  }
}

TEST_CASE("Inclined coils: the flux of one through the disk of the other") {
  const double radius = GENERATE(0.05, 0.10);
  const double degrees = GENERATE(0.0, 30.0, 60.0, 85.0);
  const double lateral = GENERATE(0.0, 0.0433, 0.20);
  const double angle = degrees * kPi / 180.0;
  const Pose inclined{{lateral, 0.0, 0.175}, {std::sin(angle), 0.0, std::cos(angle)}};
  INFO(radius << " m, " << degrees << " degrees, " << lateral << " m aside");
  CHECK(mutual_inductance(filament(0.16), Pose{}, filament(radius), inclined) ==
        Approx(flux(0.16, radius, inclined)).epsilon(1e-8));
}

TEST_CASE("Coils at right angles: the flux of one through the disk of the other") {
  const Pose upright{{0.0, 0.20, 0.12}, {0.0, 1.0, 0.0}};
  const double expected = flux(0.40, 0.10, upright);
  CHECK(expected > 1e-9);  // more field leaves the disk's lower half than its upper one
  CHECK(mutual_inductance(filament(0.40), Pose{}, filament(0.10), upright) ==
        Approx(expected).epsilon(1e-8));
  const Pose centred{{0.0, 0.0, 0.12}, {0.0, 1.0, 0.0}};
  CHECK(mutual_inductance(filament(0.40), Pose{}, filament(0.10), centred) ==
        Approx(0.0).margin(1e-20));
}

TEST_CASE("Coils displaced sideways: Conway's integral of Bessel functions") {
  for (const double lateral : {0.0, 0.01, 0.03, 0.045, 0.08}) {
    const Pose pose{{lateral, 0.0, 0.02}, Vector3d::UnitZ()};
    CHECK(mutual_inductance(filament(0.03), Pose{}, filament(0.015), pose) ==
          Approx(conway(0.03, 0.015, lateral, 0.02)).epsilon(1e-7));
  }
}

TEST_CASE("Any position and orientation: Neumann's double integral") {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    const Pose first{0.1 * random_vector(generator), random_vector(generator)};
    Pose second{first.position + 0.2 * random_vector(generator), random_vector(generator)};
    const Vector3d apart = second.position - first.position;
    second.position += 0.06 * apart.normalized();  // the wires stay a centimetre apart at least
    const double exact = neumann(kReaderCoil, first, kTagCoil, second, 160);
    const double scale = maxwell(kReaderCoil, kTagCoil, (second.position - first.position).norm());
    CHECK(mutual_inductance(kReaderCoil, first, kTagCoil, second) ==
          Approx(exact).margin(2e-9 * scale).epsilon(1e-9));
  }
}

TEST_CASE("The wires two per cent of a radius apart, it is still exact") {
  const Pose above{{0.014, 0.0, 0.0006}, {0.0, 0.0, 1.0}};
  const double exact = neumann(filament(0.030), Pose{}, filament(0.016), above, 3000);
  CHECK(mutual_inductance(filament(0.030), Pose{}, filament(0.016), above) ==
        Approx(exact).epsilon(1e-9));
}

TEST_CASE("It does not matter which coil is the first") {
  std::mt19937 generator(2);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose first{Vector3d::Zero(), random_vector(generator)};
    const Pose second{0.05 * random_vector(generator), random_vector(generator)};
    if (gap(wire(kReaderCoil, first), wire(kTagCoil, second)) < 2e-3)
      continue;  // of wires of 0.5 mm
    ++compared;
    const double one_way = mutual_inductance(kReaderCoil, first, kTagCoil, second);
    const double other_way = mutual_inductance(kTagCoil, second, kReaderCoil, first);
    CHECK(one_way == Approx(other_way).epsilon(1e-8).margin(1e-17));
  }
  CHECK(compared > 150);
}

TEST_CASE("Far away the coils are dipoles, and M falls with the third power of the distance") {
  const double a = kReaderCoil.radius;
  const double b = kTagCoil.radius;
  const double moments =
      kVacuumPermeability * kPi / 4.0 * kReaderCoil.turns * kTagCoil.turns * a * a * b * b;
  const Vector3d direction = Vector3d(1.0, 2.0, -2.0) / 3.0;
  const Vector3d n1 = Vector3d(2.0, -1.0, 2.0) / 3.0;
  const Vector3d n2(0.6, 0.0, 0.8);
  const double angles = 3.0 * n1.dot(direction) * n2.dot(direction) - n1.dot(n2);
  for (const double d : {3.0, 30.0, 3000.0}) {
    CHECK(mutual_inductance(kReaderCoil, {Vector3d::Zero(), n1}, kTagCoil, {d * direction, n2}) ==
          Approx(moments * angles / (d * d * d)).epsilon(0.02 / (d * d)));
  }
}

TEST_CASE("Of all positions in a plane and all tilts the aligned one couples best") {
  const double best = mutual_inductance(kReaderCoil, Pose{}, kTagCoil, along_z(0.03));
  for (int mm = 1; mm <= 60; ++mm) {
    const Pose aside{{mm * 1e-3, 0.0, 0.03}, Vector3d::UnitZ()};
    CHECK(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, aside) < best);
  }
  for (int degrees = 1; degrees <= 180; ++degrees) {
    const double angle = degrees * kPi / 180.0;
    const Pose tilted{{0.0, 0.0, 0.03}, {std::sin(angle), 0.0, std::cos(angle)}};
    CHECK(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, tilted) < best);
  }
}

TEST_CASE("Turned round, the flux has the other sign; at right angles on the axis there is none") {
  const auto tilted = [](double degrees, double length) {
    const double angle = degrees * kPi / 180.0;
    const Vector3d axis = length * Vector3d(0.0, std::sin(angle), std::cos(angle));
    return mutual_inductance(kReaderCoil, Pose{}, kTagCoil, {{0.0, 0.0, 0.04}, axis});
  };
  const double coaxial = tilted(0, 1.0);
  CHECK(tilted(180, 1.0) == Approx(-coaxial));
  CHECK(tilted(90, 1.0) == Approx(0.0).margin(1e-9 * coaxial));
  CHECK(tilted(60, 7.0) == Approx(tilted(60, 1.0)));
}

TEST_CASE("Only where the coils are to each other matters") {
  const Eigen::AngleAxisd turn(1.1, Vector3d(1.0, -2.0, 0.5).normalized());
  const Pose tag{{0.01, -0.02, 0.03}, {0.2, 0.1, 1.0}};
  const Pose moved_reader{{1.0, 2.0, 3.0}, turn * Vector3d::UnitZ()};
  const Pose moved_tag{moved_reader.position + turn * tag.position, turn * tag.axis};
  CHECK(mutual_inductance(kReaderCoil, moved_reader, kTagCoil, moved_tag) ==
        Approx(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, tag)).epsilon(1e-9));
}

TEST_CASE("It falls steadily along the axis, and stays finite where the wires touch") {
  double last = mutual_inductance(kReaderCoil, Pose{}, kTagCoil, along_z(0.0));
  for (int mm = 1; mm <= 1000; ++mm) {
    const double mutual = mutual_inductance(kReaderCoil, Pose{}, kTagCoil, along_z(mm * 1e-3));
    CHECK(mutual > 0.0);
    CHECK(mutual < last);
    last = mutual;
  }
  const Pose touching{{0.015, 0.0, 0.0}, Vector3d::UnitZ()};
  CHECK(std::isfinite(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, touching)));
}

TEST_CASE("A coil is its own mutual inductance at the distance of its wire's radius") {
  const Coil thin{0.030, 4, 30e-6, 0.0, 10.0};
  const double own = mutual_inductance(thin, Pose{}, thin, Pose{});
  CHECK(own == Approx(inductance(thin)).epsilon(1e-4));
  CHECK(coupling_factor(thin, thin, own) == Approx(1.0).epsilon(1e-4));
  CHECK(coupling_factor(thin, thin, 2.0 * own) == 1.0);
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

TEST_CASE("The coupling factor does not depend on the numbers of turns, nor on the flux's sign") {
  Coil reader = kReaderCoil;
  reader.turns = 1;
  const double four = mutual_inductance(kReaderCoil, Pose{}, kTagCoil, along_z(0.04));
  const double one = mutual_inductance(reader, Pose{}, kTagCoil, along_z(0.04));
  CHECK(coupling_factor(reader, kTagCoil, one) ==
        Approx(coupling_factor(kReaderCoil, kTagCoil, four)));
  CHECK(coupling_factor(kReaderCoil, kTagCoil, -four) ==
        coupling_factor(kReaderCoil, kTagCoil, four));
}

TEST_CASE("The field along the axis: of a ring near by, of a dipole far away, or too weak") {
  const Coil& coil = kReaderCoil;
  for (const double current : {0.1, 0.3, 10.0}) {
    const double reach = field_reach(coil, current, 1.5);
    // Biot and Savart, piece by piece of the ring
    double field = 0;
    for (int i = 0; i < 360; ++i) {
      const double length = 2 * kPi * coil.radius / 360;
      const double distance = std::hypot(coil.radius, reach);
      field +=
          coil.turns * current * length / (4 * kPi * distance * distance) * coil.radius / distance;
    }
    CHECK(field == Approx(1.5));
  }
  const double moment = coil.turns * 1e4 * kPi * coil.radius * coil.radius;
  CHECK(field_reach(coil, 1e4, 1.5) == Approx(std::cbrt(moment / (2 * kPi * 1.5))).epsilon(1e-3));
  CHECK(field_reach(coil, 0.01, 1.5) == 0.0);  // 0.67 A/m in its middle
  CHECK(field_reach(coil, 0, 1.5) == 0.0);
}

TEST_CASE("A normal of length zero is refused") {
  Pose flat = along_z(0.04);
  flat.axis.setZero();
  CHECK_THROWS_WITH(mutual_inductance(kReaderCoil, Pose{}, kTagCoil, flat),
                    Catch::Contains("length zero"));
}
