// How the robot moves: from waypoint to waypoint, at rest in each.
#ifndef STRIDE_UNITS_READER_MOTION_H
#define STRIDE_UNITS_READER_MOTION_H

#include <cstddef>
#include <vector>

#include <stride/time.h>

namespace reader {

/// Where all axes are at an instant.
struct Waypoint {
  stride::Time at;
  std::vector<double> positions;  ///< one per axis [rad]
};

/// Adds `offsets` [rad] to a waypoint's positions; axes beyond their number stay where they are.
void shift(Waypoint& waypoint, const std::vector<double>& offsets);

/// The share of the way that is done after a share of the time, both 0 to 1, along the path of
/// minimum jerk between two points at rest: 10 s^3 - 15 s^4 + 6 s^5 (Flash and Hogan, "The
/// Coordination of Arm Movements", J. Neuroscience 5 (1985)). Before 0 it is 0, after 1 it is 1.
double minimum_jerk(double share_of_time);

/// The target of one axis at an instant [rad]. Before the first waypoint the axis is there, and
/// after the last one likewise. The waypoints' times rise strictly, and there is at least one.
double position(const std::vector<Waypoint>& waypoints, std::size_t axis, stride::Time time);

}  // namespace reader

#endif
