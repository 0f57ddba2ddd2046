#include "units/mujoco_world/scene/track.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace mujoco_world::scene {
namespace {

using Way = std::array<double, 3>;

constexpr double kStill = 1e-9;  // [m, rad], of rounding

Eigen::Quaterniond quaternion(const Value& value) {
  return Eigen::Quaterniond(value[3], value[0], value[1], value[2]).normalized();
}

double length(const Way& way) { return std::hypot(way[0], way[1], way[2]); }

/// The one of the two quaternions of a rotation that is nearer to the other's.
Value nearer(const Value& value, const Value& other) {
  float product = 0;
  for (std::size_t i = 0; i < 4; ++i) product += value[i] * other[i];
  if (product >= 0) return value;
  return {-value[0], -value[1], -value[2], -value[3]};
}

}  // namespace

Way way_between(TrackType type, const Value& from, const Value& to) {
  if (type == TrackType::Rotation) {
    const Eigen::AngleAxisd turn(quaternion(from).conjugate() * quaternion(to));
    const Eigen::Vector3d vector = turn.angle() * turn.axis();
    return {vector[0], vector[1], vector[2]};
  }
  Way way{};
  for (std::size_t i = 0; i < 3; ++i) way[i] = double{to[i]} - double{from[i]};
  return way;
}

void MovingTrack::open(const Way& way, double time, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = (way[i] - tolerance) / time;
    high[i] = (way[i] + tolerance) / time;
  }
}

bool MovingTrack::accepts(const Way& way, double time) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (way[i] < low[i] * time || way[i] > high[i] * time) return false;
  }
  return true;
}

std::optional<TimedValue> MovingTrack::observe(TrackType type, const TimedValue& sample,
                                               double tolerance) {
  if (!has_keyframe) {
    has_keyframe = true;
    keyframe = sample;
    return keyframe;
  }
  const double of_coordinate = tolerance / std::sqrt(3.0);
  TimedValue seen = sample;
  if (type == TrackType::Rotation) seen.value = nearer(seen.value, keyframe.value);
  Way way = way_between(type, keyframe.value, seen.value);
  double time = double{seen.time} - double{keyframe.time};
  moves = moves || length(way) > kStill;
  if (!has_candidate) {
    has_candidate = true;
    candidate = seen;
    open(way, time, of_coordinate);
    return std::nullopt;
  }
  const bool turns_too_far = type == TrackType::Rotation && length(way) > kLongestTurn;
  if (!turns_too_far && accepts(way, time)) {
    const MovingTrack before = *this;
    open(way, time, of_coordinate);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::max(low[i], before.low[i]);
      high[i] = std::min(high[i], before.high[i]);
    }
    candidate = seen;
    return std::nullopt;
  }
  keyframe = candidate;
  if (type == TrackType::Rotation) seen.value = nearer(seen.value, keyframe.value);
  way = way_between(type, keyframe.value, seen.value);
  time = double{seen.time} - double{keyframe.time};
  candidate = seen;
  open(way, time, of_coordinate);
  return keyframe;
}

}  // namespace mujoco_world::scene
