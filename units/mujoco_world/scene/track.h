// How a number of samples becomes fewer keyframes.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_TRACK_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_TRACK_H

#include <array>
#include <optional>

#include "units/mujoco_world/scene/keyframe_log.h"

namespace mujoco_world::scene {

enum class TrackType {
  Point,     ///< moves straight between keyframes
  Rotation,  ///< turns about a fixed axis between them (slerp)
  Switch     ///< keeps its value until the next one
};

struct TimedValue {
  float time = 0;
  Value value{};
};

/// Keyframes of what moves, by the cone of directions in which the next one may lie: from a
/// keyframe on, a sample is passed over as long as all since then, it included, are nearer than the
/// tolerance to the way from there to the last one. So each keyframe is one of the samples, and
/// what is interpolated is within the tolerance [m, rad] of each sample. Memory is constant. (The
/// cone is that of J. Sklansky, V. Gonzalez, "Fast polygonal approximation of digitized curves",
/// Pattern Recognition 12(5), 1980, over time, for each coordinate with 1/sqrt(3) of the
/// tolerance.)
///
/// Rotations are compared as rotation vectors from the keyframe, in which slerp is straight; two
/// rotations are never farther apart than their vectors. No way turns by more than kLongestTurn.
///
/// Its members are all of its state.
struct MovingTrack {
  TimedValue keyframe;                  ///< the last one
  TimedValue candidate;                 ///< the last sample, where there is one after the keyframe
  std::array<double, 3> low{}, high{};  ///< of the directions [1/s]
  bool has_keyframe = false;
  bool has_candidate = false;
  bool moves = false;  ///< whether any sample was elsewhere than the first

  static constexpr double kLongestTurn = 1;  // [rad]

  /// Returns the keyframe that a sample, later than the last, shows to be needed.
  std::optional<TimedValue> observe(TrackType type, const TimedValue& sample, double tolerance);

 private:
  void open(const std::array<double, 3>& way, double time, double tolerance);
  bool accepts(const std::array<double, 3>& way, double time) const;
};

/// From one value to another: the difference of points, or the rotation vector.
std::array<double, 3> way_between(TrackType type, const Value& from, const Value& to);

}  // namespace mujoco_world::scene

#endif
