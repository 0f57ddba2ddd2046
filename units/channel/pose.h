// Where an antenna is, and which way it points.
#ifndef STRIDE_UNITS_CHANNEL_POSE_H
#define STRIDE_UNITS_CHANNEL_POSE_H

#include <Eigen/Core>

namespace channel {

/// In coordinates that all antennas share.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< the antenna's centre [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();     ///< of any length but zero

  bool operator==(const Pose& other) const {
    return position == other.position && axis == other.axis;
  }
};

}  // namespace channel

#endif
