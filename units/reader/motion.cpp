#include "units/reader/motion.h"

#include <algorithm>

namespace reader {

double minimum_jerk(double share_of_time) {
  const double s = std::clamp(share_of_time, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

void shift(Waypoint& waypoint, const std::vector<double>& offsets) {
  const std::size_t size = std::min(waypoint.positions.size(), offsets.size());
  for (std::size_t i = 0; i < size; ++i) waypoint.positions[i] += offsets[i];
}

double position(const std::vector<Waypoint>& waypoints, std::size_t axis, stride::Time time) {
  const auto next =
      std::upper_bound(waypoints.begin(), waypoints.end(), time,
                       [](stride::Time t, const Waypoint& waypoint) { return t < waypoint.at; });
  if (next == waypoints.begin()) return next->positions[axis];
  const auto last = next - 1;
  if (next == waypoints.end()) return last->positions[axis];
  const double share =
      stride::to_seconds(time - last->at) / stride::to_seconds(next->at - last->at);
  const double from = last->positions[axis];
  return from + (next->positions[axis] - from) * minimum_jerk(share);
}

}  // namespace reader
