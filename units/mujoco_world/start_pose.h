// Where a world begins: a keyframe of the model, and joints that begin elsewhere.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_START_POSE_H
#define STRIDE_UNITS_MUJOCO_WORLD_START_POSE_H

#include <string>
#include <vector>

#include <mujoco/mujoco.h>

namespace mujoco_world {

/// The keyframe with which a world begins if nothing else is said.
inline constexpr const char* kStartKeyframe = "start";

struct StartPose {
  std::string keyframe;  ///< empty: the model's reference pose
  /// One for each number of qpos, in its unit; NaN: as the keyframe has it. Empty: all are NaN.
  std::vector<double> positions;
};

/// The keyframe called `start` if the model has one, else the reference pose.
StartPose default_start(const mjModel& model);

/// A number of qpos as a parameter.
struct StartPosition {
  std::string parameter;    ///< joint.NAME.start, body.NAME.start.position.x, …
  std::string unit;         ///< "rad", "m", or "" in an orientation
  std::string description;  ///< what it is the start of
};

/// One for each number of qpos. A free joint's are named after its body, since it has mostly no
/// name of its own. An orientation is a quaternion, w x y z. Throws as name_part() does.
std::vector<StartPosition> list_start_positions(const mjModel& model);

/// Puts the state at the start of `pose`. Quaternions are normalised. Throws std::invalid_argument,
/// with what there is, for a keyframe that the model does not have, a position that is infinite,
/// and an orientation of which a part is missing or which is zero.
void put_at_start(const mjModel& model, mjData& data, const StartPose& pose);

/// What is wrong with a pose that can be simulated nevertheless, a sentence for each: bodies that
/// penetrate each other by more than contacts at rest do, and joints that are outside of their
/// range. mj_collision() must have been called for `data`.
std::vector<std::string> flaws_of_pose(const mjModel& model, const mjData& data);

}  // namespace mujoco_world

#endif
