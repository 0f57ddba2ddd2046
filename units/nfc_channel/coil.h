// The geometry of the two antennas and the magnetic coupling between them.
#ifndef STRIDE_UNITS_NFC_CHANNEL_COIL_H
#define STRIDE_UNITS_NFC_CHANNEL_COIL_H

#include <Eigen/Core>

namespace nfc_channel {

inline constexpr double kVacuumPermeability = 1.25663706212e-6;  ///< [H/m], CODATA 2018

/// A flat circular coil whose turns lie on top of each other.
struct Coil {
  double radius;          ///< of the turns' centre line [m]
  double turns;           ///< number of turns
  double wire_radius;     ///< [m]
  double inductance;      ///< [H]; 0 takes it from the geometry
  double quality_factor;  ///< of the resonant circuit at the carrier frequency
};

/// Where a coil is, in coordinates that both coils share.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< the coil's centre [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< its normal, of any length but zero
};

/// The inductance [H]: the coil's own value if it has one, otherwise N^2 mu0 a (ln(8a/w) - 2), a
/// thin ring whose current flows on the wire's surface (Grover, "Inductance Calculations", 1946).
double inductance(const Coil& coil);

/// The mutual inductance [H] of two coaxial coils whose planes are `distance` [m] apart, by
/// Maxwell's closed form ("A Treatise on Electricity and Magnetism", art. 701):
///     M = mu0 N1 N2 sqrt(ab) ((2/q - q) K(q) - (2/q) E(q)),  q^2 = 4ab / ((a+b)^2 + d^2)
/// Two wires' centre lines come no closer than a wire's radius, which keeps the value finite.
double coaxial_mutual_inductance(const Coil& first, const Coil& second, double distance);

/// The coupling factor k = M / sqrt(L1 L2), from 0 to 1. A first approximation of coils that are
/// not coaxial: M of coaxial coils at the distance between the centres, times |cos| of the angle
/// between the normals. Throws std::invalid_argument for a normal of length zero.
double coupling_factor(const Coil& first, const Pose& first_pose, const Coil& second,
                       const Pose& second_pose);

}  // namespace nfc_channel

#endif
