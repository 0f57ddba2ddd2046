#include "units/mujoco_world/scene/track.h"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using mujoco_world::scene::MovingTrack;
using mujoco_world::scene::TimedValue;
using mujoco_world::scene::TrackType;
using mujoco_world::scene::Value;

namespace {

/// The keyframes of samples, the last one included.
std::vector<TimedValue> keyframes_of(TrackType type, const std::vector<TimedValue>& samples,
                                     double tolerance) {
  MovingTrack track;
  std::vector<TimedValue> keyframes;
  for (const TimedValue& sample : samples) {
    if (const auto needed = track.observe(type, sample, tolerance)) keyframes.push_back(*needed);
  }
  if (track.has_candidate) keyframes.push_back(track.candidate);
  return keyframes;
}

/// The greatest distance of a sample from what is interpolated [m, rad].
double error(TrackType type, const std::vector<TimedValue>& samples,
             const std::vector<TimedValue>& keyframes) {
  double most = 0;
  std::size_t next = 1;
  for (const TimedValue& sample : samples) {
    while (next + 1 < keyframes.size() && keyframes[next].time < sample.time) ++next;
    const TimedValue& from = keyframes[next - 1];
    const TimedValue& to = keyframes[std::min(next, keyframes.size() - 1)];
    const double share =
        to.time > from.time ? (double{sample.time} - from.time) / (double{to.time} - from.time) : 0;
    if (type == TrackType::Rotation) {
      const auto turn = [](const Value& v) {
        return Eigen::Quaterniond(v[3], v[0], v[1], v[2]).normalized();
      };
      const Eigen::Quaterniond shown = turn(from.value).slerp(share, turn(to.value));
      most = std::max(most, shown.angularDistance(turn(sample.value)));
    } else {
      Eigen::Vector3d way;
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        way[i] = from.value[k] + share * (double{to.value[k]} - from.value[k]) - sample.value[k];
      }
      most = std::max(most, way.norm());
    }
  }
  return most;
}

TimedValue turned(float time, const Eigen::Quaterniond& turn) {
  return {time,
          {static_cast<float>(turn.x()), static_cast<float>(turn.y()), static_cast<float>(turn.z()),
           static_cast<float>(turn.w())}};
}

/// A walk without rest, now smooth, now not.
std::vector<TimedValue> walk(TrackType type, unsigned seed, double jump) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<TimedValue> samples;
  Eigen::Vector3d place(0, 0, 0);
  Eigen::Vector3d speed(0.1, 0, 0);
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (int i = 0; i < 3000; ++i) {
    const auto time = static_cast<float>(0.01 * i);
    if (i % 7 == 0) speed += jump * Eigen::Vector3d(normal(random), normal(random), normal(random));
    speed *= 0.95;
    place += 0.01 * speed;
    const double angle = 0.01 * speed.norm();
    turn = turn * Eigen::AngleAxisd(angle, speed.normalized());
    turn.normalize();
    if (type == TrackType::Rotation) {
      const bool is_other_sign = i % 11 == 0;
      samples.push_back(turned(time, is_other_sign ? Eigen::Quaterniond(-turn.coeffs()) : turn));
    } else {
      samples.push_back({time,
                         {static_cast<float>(place.x()), static_cast<float>(place.y()),
                          static_cast<float>(place.z()), 0}});
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("keyframes are within the tolerance of each sample, and fewer") {
  const TrackType type = GENERATE(TrackType::Point, TrackType::Rotation);
  const double tolerance = GENERATE(1e-5, 1e-3, 1e-1);
  const double jump = GENERATE(0.05, 5.0);
  const auto samples = walk(type, 5, jump);
  const auto keyframes = keyframes_of(type, samples, tolerance);
  CAPTURE(tolerance, jump, keyframes.size());
  CHECK(error(type, samples, keyframes) <= tolerance * 1.0001 + 3e-7);  // of single precision
  CHECK(keyframes.front().time == samples.front().time);
  CHECK(keyframes.back().time == samples.back().time);
  if (tolerance >= 1e-3 && jump < 1) CHECK(keyframes.size() < samples.size() / 2);
}

TEST_CASE("what stands still or moves evenly has two keyframes") {
  const bool moves = GENERATE(false, true);
  std::vector<TimedValue> points;
  std::vector<TimedValue> turns;
  for (int i = 0; i <= 1000; ++i) {
    const auto time = static_cast<float>(0.1 * i);
    points.push_back({time, {moves ? 0.25F * time : 1, 2, 3, 0}});
    const double angle = moves ? 0.005 * double{time} : 0.3;
    turns.push_back(turned(
        time, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()))));
  }
  CHECK(keyframes_of(TrackType::Point, points, 1e-5).size() == 2);
  CHECK(keyframes_of(TrackType::Rotation, turns, 1e-6).size() == 2);
}

TEST_CASE("no way between two keyframes turns so far that it might be the other way round") {
  std::vector<TimedValue> turns;
  for (int i = 0; i <= 1000; ++i) {
    turns.push_back(turned(static_cast<float>(0.01 * i), Eigen::Quaterniond(Eigen::AngleAxisd(
                                                             0.03 * i, Eigen::Vector3d::UnitY()))));
  }
  const auto keyframes = keyframes_of(TrackType::Rotation, turns, 1e-5);
  CHECK(keyframes.size() == 32);  // 30 rad, 33 samples each
  CHECK(error(TrackType::Rotation, turns, keyframes) < 1e-5);
}
