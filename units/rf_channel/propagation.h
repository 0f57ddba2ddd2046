// From one antenna to another over a plane: free space, and the ray that the ground reflects.
#ifndef STRIDE_UNITS_RF_CHANNEL_PROPAGATION_H
#define STRIDE_UNITS_RF_CHANNEL_PROPAGATION_H

#include <complex>
#include <cstdint>

#include "units/channel/pose.h"

namespace rf_channel {

using channel::Pose;

inline constexpr double kSpeedOfLight = 299792458.0;             ///< [m/s]
inline constexpr double kVacuumPermittivity = 8.8541878128e-12;  ///< [F/m], CODATA 2018
inline constexpr double kVacuumImpedance = 376.730313668;        ///< [Ohm], CODATA 2018

/// What both antennas are like. The isotropic ones do not exist, but are what formulas for paths
/// over the ground are written for: alike in all directions, of one polarisation, always matched.
enum class Antenna : std::int64_t {
  IsotropicVertical = 0,    ///< the electric field in the plane of incidence
  IsotropicHorizontal = 1,  ///< the electric field parallel to the ground
  Dipole = 2,               ///< short, along the pose's axis
};

/// A plane across the z axis, of one material.
struct Ground {
  bool reflects = true;
  double height = 0.0;         ///< its z [m]
  double permittivity = 15.0;  ///< relative
  double conductivity = 5e-3;  ///< [S/m]
};

/// What is the same wherever the antennas are.
struct PathConditions {
  Antenna antenna;  ///< of both
  double gain;      ///< of both, as a product, in their best direction
  Ground ground;
  double frequency;  ///< [Hz]
};

struct Reflection {
  std::complex<double> vertical, horizontal;
};

/// Fresnel's reflection coefficients at the angle psi between ray and ground, with the complex
/// relative permittivity e = e_r - j sigma / (omega e_0):
///
///     horizontal = (sin psi - sqrt(e - cos^2 psi)) / (sin psi + sqrt(e - cos^2 psi))
///     vertical = (e sin psi - sqrt(e - cos^2 psi)) / (e sin psi + sqrt(e - cos^2 psi))
///
/// (T. S. Rappaport, "Wireless Communications", 2nd ed., eq. 4.24 and 4.25; J. D. Parsons, "The
/// Mobile Radio Propagation Channel", 2nd ed., eq. 2.9 and 2.11.) Vertical is of the magnetic
/// field, so that it is +1 for a conductor and -1 at grazing incidence. Frequency in [Hz].
Reflection reflection(const Ground& ground, double sine_of_angle, double frequency);

/// The share of the sent power that the other antenna delivers to a matched receiver:
///
///     |lambda / (4 pi) sqrt(G_r G_t) (c_1 exp(-j k d_1) / d_1 + c_2 exp(-j k d_2) / d_2)|^2
///
/// The first ray is direct: Friis' equation (H. T. Friis, Proc. IRE 34 (1946)). The second comes
/// from the image of the other antenna below the ground, reflected by it (Rappaport, section 4.6;
/// Parsons, section 2.3). For isotropic antennas c_1 is 1 and c_2 the reflection coefficient of
/// their polarisation. For dipoles along a and b the rays are weighted by pattern and polarisation:
/// a ray in the direction u carries a field along a - (a u) u, the dipole's sin(theta) pattern
/// (C. A. Balanis, "Antenna Theory", 4th ed., section 4.2 and 2.12); the ground reflects its parts
/// in the plane of incidence and across it with a coefficient each, and b takes its part of what
/// arrives. The gain is G_r G_t.
///
/// Far fields only: antennas count as no nearer than lambda / (2 pi), where a short dipole's near
/// field begins, and never get more than was sent. An antenna below a ground that reflects gets
/// nothing.
double path_gain(const Pose& first, const Pose& second, const PathConditions& conditions);

}  // namespace rf_channel

#endif
