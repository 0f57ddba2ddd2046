#include "units/rf_channel/propagation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace rf_channel {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

// Straight up, or from an antenna to itself, the plane of incidence is any upright one.
Vector3d across(const Vector3d& direction) {
  const Vector3d normal = Vector3d::UnitZ().cross(direction);
  return normal.norm() > 1e-12 ? Vector3d(normal.normalized()) : Vector3d::UnitY();
}

Vector3d direction_of(const Vector3d& path) {
  return path.norm() > 0.0 ? Vector3d(path.normalized()) : Vector3d::UnitX();
}

Vector3d mirrored(Vector3d vector, double height = 0.0) {
  vector.z() = 2.0 * height - vector.z();
  return vector;
}

/// The direct way between two antennas, and the one by way of the ground.
struct Rays {
  const Pose& first;
  const Pose& second;
  Antenna antenna;
  const Ground& ground;
  double frequency;

  double wavelength() const { return kSpeedOfLight / frequency; }

  Complex ray(double length) const {
    const double least = wavelength() / (2.0 * M_PI);
    return std::polar(1.0 / std::max(length, least), -2.0 * M_PI * length / wavelength());
  }

  Complex direct() const {
    const Vector3d path = second.position - first.position;
    return direct_weight(direction_of(path)) * ray(path.norm());
  }

  double direct_weight(const Vector3d& u) const {
    if (antenna != Antenna::Dipole) return 1.0;
    const Vector3d a = first.axis.normalized();
    const Vector3d b = second.axis.normalized();
    return a.dot(b) - a.dot(u) * b.dot(u);
  }

  Complex reflected() const {
    const Vector3d path = mirrored(second.position, ground.height) - first.position;
    const Vector3d u = direction_of(path);
    return reflected_weight(u, reflection(ground, std::abs(u.z()), frequency)) * ray(path.norm());
  }

  Complex reflected_weight(const Vector3d& down, const Reflection& reflection) const {
    if (antenna == Antenna::IsotropicVertical) return reflection.vertical;
    if (antenna == Antenna::IsotropicHorizontal) return reflection.horizontal;
    const Vector3d a = first.axis.normalized();
    const Vector3d b = second.axis.normalized();
    const Vector3d side = across(down);
    const Vector3d before = side.cross(down);           // in the plane of incidence, across the ray
    const Vector3d after = side.cross(mirrored(down));  // likewise, once it is reflected
    return reflection.horizontal * a.dot(side) * b.dot(side) +
           reflection.vertical * a.dot(before) * b.dot(after);
  }
};

}  // namespace

Reflection reflection(const Ground& ground, double sine, double frequency) {
  const double omega = 2.0 * M_PI * frequency;
  const Complex permittivity{ground.permittivity,
                             -ground.conductivity / (omega * kVacuumPermittivity)};
  const Complex root = std::sqrt(permittivity - (1.0 - sine * sine));
  return {(permittivity * sine - root) / (permittivity * sine + root),
          (sine - root) / (sine + root)};
}

double path_gain(const Pose& first, const Pose& second, const PathConditions& conditions) {
  const Ground& ground = conditions.ground;
  const Rays rays{first, second, conditions.antenna, ground, conditions.frequency};
  Complex field = rays.direct();
  if (ground.reflects) {
    if (std::min(first.position.z(), second.position.z()) < ground.height) return 0.0;
    field += rays.reflected();
  }
  const double amplitude = rays.wavelength() / (4.0 * M_PI) * std::abs(field);
  return std::min(1.0, conditions.gain * amplitude * amplitude);
}

}  // namespace rf_channel
