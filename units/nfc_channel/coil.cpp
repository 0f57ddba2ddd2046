#include "units/nfc_channel/coil.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

namespace nfc_channel {
namespace {

constexpr double kPi = 3.14159265358979323846;

// (2/q - q) K(q) - (2/q) E(q). The three terms cancel for a small modulus, where the first terms of
// the power series are the more exact.
double maxwell_factor(double modulus) {
  const double q = modulus;
  if (q < 0.03) {
    return kPi / 16.0 * q * q * q * (1.0 + q * q * (3.0 / 4.0 + q * q * 75.0 / 128.0));
  }
  return (2.0 / q - q) * std::comp_ellint_1(q) - 2.0 / q * std::comp_ellint_2(q);
}

double abs_cosine(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  const double lengths = first.norm() * second.norm();
  if (!(lengths > 0.0)) {
    throw std::invalid_argument("the axis of a coil has length zero: expected its normal vector");
  }
  return std::min(1.0, std::abs(first.dot(second)) / lengths);
}

}  // namespace

double inductance(const Coil& coil) {
  if (coil.inductance > 0.0) return coil.inductance;
  return coil.turns * coil.turns * kVacuumPermeability * coil.radius *
         (std::log(8.0 * coil.radius / coil.wire_radius) - 2.0);
}

double coaxial_mutual_inductance(const Coil& first, const Coil& second, double distance) {
  const double a = first.radius;
  const double b = second.radius;
  const double d = std::max({std::abs(distance), first.wire_radius, second.wire_radius});
  const double modulus = std::sqrt(4.0 * a * b / ((a + b) * (a + b) + d * d));
  return kVacuumPermeability * first.turns * second.turns * std::sqrt(a * b) *
         maxwell_factor(modulus);
}

double coupling_factor(const Coil& first, const Pose& first_pose, const Coil& second,
                       const Pose& second_pose) {
  const double distance = (second_pose.position - first_pose.position).norm();
  const double mutual = coaxial_mutual_inductance(first, second, distance) *
                        abs_cosine(first_pose.axis, second_pose.axis);
  return std::min(1.0, mutual / std::sqrt(inductance(first) * inductance(second)));
}

}  // namespace nfc_channel
