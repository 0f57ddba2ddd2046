#include "units/nfc_channel/coil.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

namespace nfc_channel {
namespace {

using Eigen::Vector3d;

Vector3d unit_vector(const Vector3d& axis) {
  const double length = axis.norm();
  if (!(length > 0.0)) {
    throw std::invalid_argument("the axis of a coil has length zero: expected its normal vector");
  }
  return axis / length;
}

// A_phi / rho for a current of 1 A in a ring of the radius a, at the distance rho from its axis and
// z from its plane. With s^2 = (a+rho)^2 + z^2, k^2 = 4 a rho / s^2 and k'^2 = 1 - k^2 Jackson's
//     A_phi = mu0 / (pi k) sqrt(a / rho) ((1 - k^2/2) K(k) - E(k))
// loses all digits near the axis. The arithmetic-geometric mean of 1 and k' (Abramowitz and Stegun,
// 17.6) gives (1 - k^2/2) K - E = K (c1^2 + 2 c2^2 + 4 c3^2 + ...) with no difference in it, and
// the small factors rho can be taken out.
double potential_over_rho(double a, double rho, double z, double least_gap) {
  const double across = (a - rho) * (a - rho);
  const double z_squared = std::max(z * z, least_gap * least_gap - across);
  const double s_squared = (a + rho) * (a + rho) + z_squared;
  const double complement = std::sqrt((across + z_squared) / s_squared);  // k'

  double arithmetic = 0.5 * (1.0 + complement);
  double geometric = std::sqrt(complement);
  double c = 2.0 * a * rho / (s_squared * (1.0 + complement));
  double ratio = 1.0;  // c_n / c_1
  double weight = 1.0;
  double sum = 1.0;
  while (c > 1e-8 * arithmetic) {
    const double next = 0.5 * (arithmetic + geometric);
    geometric = std::sqrt(arithmetic * geometric);
    arithmetic = next;
    ratio *= c / (4.0 * next);
    c *= c / (4.0 * next);
    weight *= 2.0;
    sum += weight * ratio * ratio;
  }
  const double one_and_complement = 1.0 + complement;
  return kVacuumPermeability * a * a * sum /
         (arithmetic * s_squared * std::sqrt(s_squared) * one_and_complement * one_and_complement);
}

// The second coil's path in the first one's coordinates, and A dl along it.
class Path {
 public:
  Path(const Coil& first, const Pose& first_pose, const Coil& second, const Pose& second_pose)
      : source_radius_(first.radius),
        source_axis_(unit_vector(first_pose.axis)),
        radius_(second.radius),
        centre_(second_pose.position - first_pose.position),
        least_gap_(std::max(first.wire_radius, second.wire_radius)) {
    const Vector3d axis = unit_vector(second_pose.axis);
    u_ = axis.unitOrthogonal();
    v_ = axis.cross(u_);
  }

  // A dl / d(angle)
  double operator()(double angle) const {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const Vector3d point = centre_ + radius_ * (cosine * u_ + sine * v_);
    const Vector3d around = source_axis_.cross(point);  // rho times the direction of A
    const double rho = around.norm();
    return potential_over_rho(source_radius_, rho, source_axis_.dot(point), least_gap_) * radius_ *
           around.dot(cosine * v_ - sine * u_);
  }

 private:
  double source_radius_;
  Vector3d source_axis_;
  double radius_;
  Vector3d centre_;
  double least_gap_;
  Vector3d u_, v_;
};

struct Sum {
  double value = 0.0;
  double magnitude = 0.0;

  void add(const Path& path, int points, double offset) {
    for (int i = 0; i < points; ++i) {
      const double term = path(2.0 * M_PI * (i + offset) / points);
      value += term;
      magnitude += std::abs(term);
    }
  }
};

}  // namespace

double inductance(const Coil& coil) {
  if (coil.inductance > 0.0) return coil.inductance;
  return coil.turns * coil.turns * kVacuumPermeability * coil.radius *
         (std::log(8.0 * coil.radius / coil.wire_radius) - 2.0);
}

double mutual_inductance(const Coil& first, const Pose& first_pose, const Coil& second,
                         const Pose& second_pose) {
  constexpr int kMostPoints = 2048;
  constexpr double kTolerance = 1e-9;  // of the last doubling; doubling squares the error
  const Path path(first, first_pose, second, second_pose);
  int points = 16;
  Sum sum;
  sum.add(path, points, 0.0);
  for (bool done = false; !done;) {
    const double coarse = 2.0 * sum.value;
    sum.add(path, points, 0.5);
    points *= 2;
    done = std::abs(sum.value - coarse) <= kTolerance * sum.magnitude || points >= kMostPoints;
  }
  return first.turns * second.turns * 2.0 * M_PI / points * sum.value;
}

double field_reach(const Coil& coil, double current, double field_strength) {
  const double moment = coil.turns * current * coil.radius * coil.radius;
  const double square =
      std::pow(moment / (2.0 * field_strength), 2.0 / 3.0) - coil.radius * coil.radius;
  return square > 0.0 ? std::sqrt(square) : 0.0;
}

double coupling_factor(const Coil& first, const Coil& second, double mutual_inductance) {
  return std::min(1.0,
                  std::abs(mutual_inductance) / std::sqrt(inductance(first) * inductance(second)));
}

}  // namespace nfc_channel
