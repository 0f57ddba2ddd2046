// The geometry of two antennas and the magnetic coupling between them.
#ifndef STRIDE_UNITS_NFC_CHANNEL_COIL_H
#define STRIDE_UNITS_NFC_CHANNEL_COIL_H

#include "units/channel/pose.h"

namespace nfc_channel {

inline constexpr double kVacuumPermeability = 1.25663706212e-6;  ///< [H/m], CODATA 2018

/// A flat circular coil whose turns lie on top of each other.
struct Coil {
  double radius;          ///< of the turns' centre line [m]
  double turns;           ///< number of turns
  double wire_radius;     ///< [m]
  double inductance;      ///< [H]; 0 takes it from the geometry
  double quality_factor;  ///< omega L / R of the coil at the carrier frequency
};

/// The coil's centre and its normal.
using channel::Pose;

/// The inductance [H]: the coil's own value if it has one, otherwise N^2 mu0 a (ln(8a/w) - 2), a
/// thin ring whose current flows on the wire's surface (Grover, "Inductance Calculations", 1946).
double inductance(const Coil& coil);

/// The mutual inductance [H] of two coils in any position and orientation; negative where the flux
/// of the first passes the second against its normal. It is Neumann's double line integral, with
/// the first integration done in closed form: the vector potential A of a circular current
/// (Jackson, "Classical Electrodynamics", 3rd ed., sect. 5.5) is integrated along the second coil,
///     M = N1 N2 (closed integral of A dl) / I,
/// as Babic et al. do ("Mutual Inductance Calculation Between Circular Filaments Arbitrarily
/// Positioned in Space: Alternative to Grover's Formula", IEEE Trans. Magn. 46(9), 2010). The
/// integrand is smooth and periodic, so the trapezoidal rule converges exponentially; its points
/// are doubled until the relative error is below 1e-9 of the integral of |A dl|, as long as the
/// wires are not nearer to each other than 2 % of the second coil's radius.
///
/// Two wires' centre lines count as never closer than the thicker one's radius, which keeps the
/// value finite. Throws std::invalid_argument for a normal of length zero.
double mutual_inductance(const Coil& first, const Pose& first_pose, const Coil& second,
                         const Pose& second_pose);

/// How far along the coil's axis its field is at least `field_strength`, effective [A/m], with an
/// effective current of `current` [A]: H = N I a^2 / (2 (a^2 + z^2)^(3/2)), Biot and Savart's law
/// for a ring (Jackson, sect. 5.5). 0 if it is weaker everywhere [m].
double field_reach(const Coil& coil, double current, double field_strength);

/// The coupling factor k = |M| / sqrt(L1 L2), from 0 to 1.
double coupling_factor(const Coil& first, const Coil& second, double mutual_inductance);

}  // namespace nfc_channel

#endif
