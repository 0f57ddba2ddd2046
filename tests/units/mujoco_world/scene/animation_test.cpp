#include "units/mujoco_world/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/scratch_folder.h"

using mujoco_world::scene::Animation;
using mujoco_world::scene::AnimationLimits;
using mujoco_world::scene::AnimationState;
using mujoco_world::scene::time_of_keyframe;
using mujoco_world::scene::TimedValue;
using mujoco_world::scene::TrackType;
using mujoco_world::scene::Value;
using mujoco_world::scene::way_between;
using stride::tests::ScratchFolder;

namespace {

const std::vector<TrackType> kTypes{TrackType::Point, TrackType::Rotation, TrackType::Switch};

/// A body that is kicked about, and a lamp.
class Restless {
 public:
  explicit Restless(double blink = 0.37) : blink_(blink) {}

  std::vector<Value> at_next() {
    speed_ = 0.9 * speed_ + Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
    place_ += 1e-5 * speed_;
    turn_ = turn_ * Eigen::AngleAxisd(2e-5 * speed_.norm(), speed_.normalized());
    turn_.normalize();
    ++count_;
    const bool is_lit = static_cast<int>(count_ * 0.01 / blink_) % 2 != 0;
    return {{static_cast<float>(place_.x()), static_cast<float>(place_.y()),
             static_cast<float>(place_.z()), 0},
            {static_cast<float>(turn_.x()), static_cast<float>(turn_.y()),
             static_cast<float>(turn_.z()), static_cast<float>(turn_.w())},
            {is_lit ? 1.0F : 0.0F, 0, 0, 0}};
  }

 private:
  double blink_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
  Eigen::Vector3d speed_{0, 0, 0}, place_{0, 0, 0};
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  int count_ = 0;
};

struct Samples {
  std::vector<double> times;
  std::vector<std::vector<Value>> values;
};

Samples observe(Animation& animation, Restless world, int count) {
  Samples samples;
  for (int i = 0; i < count; ++i) {
    samples.times.push_back(0.01 * i);
    samples.values.push_back(world.at_next());
    animation.observe(samples.times.back(), samples.values.back());
  }
  return samples;
}

double distance(TrackType type, const std::vector<TimedValue>& timeline, float time,
                const Value& value) {
  const auto behind = std::upper_bound(timeline.begin(), timeline.end(), time,
                                       [](float t, const TimedValue& v) { return t < v.time; });
  if (behind == timeline.begin()) return std::numeric_limits<double>::infinity();
  const TimedValue& from = *(behind - 1);
  if (type == TrackType::Switch || behind == timeline.end()) {
    const auto way = way_between(type, from.value, value);
    return std::hypot(way[0], way[1], way[2]);
  }
  const double share = (double{time} - from.time) / (double{behind->time} - from.time);
  if (type == TrackType::Rotation) {
    const auto turn = [](const Value& v) {
      return Eigen::Quaterniond(v[3], v[0], v[1], v[2]).normalized();
    };
    return turn(from.value).slerp(share, turn(behind->value)).angularDistance(turn(value));
  }
  Eigen::Vector3d way;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    way[i] = from.value[k] + share * (double{behind->value[k]} - from.value[k]) - value[k];
  }
  return way.norm();
}

std::size_t size_of(const std::vector<std::vector<TimedValue>>& tracks) {
  std::size_t size = 0;
  for (const auto& track : tracks) size += track.size();
  return size;
}

bool are_same(const std::vector<std::vector<TimedValue>>& one,
              const std::vector<std::vector<TimedValue>>& other) {
  const auto same = [](const TimedValue& a, const TimedValue& b) {
    return a.time == b.time && a.value == b.value;
  };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [&](const auto& a, const auto& b) {
                      return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
                    });
}

AnimationLimits limited(std::size_t keyframes) {
  AnimationLimits limits;
  limits.keyframes = keyframes;
  limits.interval = 0.01;
  return limits;
}

}  // namespace

TEST_CASE("an animation that is too long gets a greater tolerance, which holds for each sample") {
  const ScratchFolder scratch;
  Animation animation(kTypes, limited(3000), scratch / "keys");
  const Samples samples = observe(animation, Restless(), 20'000);
  const auto tracks = animation.tracks(samples.times.back(), samples.values.back());
  CHECK(size_of(tracks) <= 3003);
  CHECK(size_of(tracks) > 500);
  const double tolerance = animation.tolerance();
  CHECK(tolerance > 1e-6);
  CHECK(tolerance < 1e-3);
  CHECK(animation.resolution() == 0);
  CHECK(animation.samples() == 20'000);
  double most = 0;
  double most_switched = 0;
  for (std::size_t i = 0; i < samples.times.size(); ++i) {
    const float time = time_of_keyframe(samples.times[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      most = std::max(most, distance(kTypes[k], tracks[k], time, samples.values[i][k]));
    }
    most_switched =
        std::max(most_switched, distance(kTypes[2], tracks[2], time, samples.values[i][2]));
  }
  CHECK(most_switched == 0);
  CHECK(most <= tolerance);
  CHECK(most > tolerance / 20);
}

TEST_CASE("where too much is switched, samples get farther apart") {
  const ScratchFolder scratch;
  Animation animation(kTypes, limited(2000), scratch / "keys");
  const Samples samples = observe(animation, Restless(0.01), 20'000);
  const auto tracks = animation.tracks(samples.times.back(), samples.values.back());
  CHECK(size_of(tracks) <= 2003);
  CHECK(animation.resolution() > 0.01);
  CHECK(animation.resolution() < 2);
}

TEST_CASE(
    "an animation goes back, also beyond a greater tolerance, and on as if nothing had been") {
  const int split = GENERATE(10, 500, 1490, 2999);
  const bool is_other = GENERATE(false, true);
  const ScratchFolder scratch;
  Animation straight(kTypes, limited(2000), scratch / "straight.keys");
  const Samples samples = observe(straight, Restless(), 3000);
  Animation first(kTypes, limited(2000), scratch / "keys");
  Animation second(kTypes, limited(2000), scratch / "keys");
  AnimationState state;
  for (std::size_t i = 0; i < 3000; ++i) {
    first.observe(samples.times[i], samples.values[i]);
    if (i + 1 == static_cast<std::size_t>(split)) state = first.state();
  }
  REQUIRE(straight.tolerance() > 1e-6);
  Animation& resumed = is_other ? second : first;
  REQUIRE(resumed.restore(state));
  for (std::size_t i = static_cast<std::size_t>(split); i < 3000; ++i) {
    resumed.observe(samples.times[i], samples.values[i]);
  }
  const auto end = samples.values.back();
  CHECK(are_same(resumed.tracks(30, end), straight.tracks(30, end)));
  CHECK(resumed.tolerance() == straight.tolerance());
}

TEST_CASE("keyframes that are gone are told of") {
  const ScratchFolder scratch;
  Animation first(kTypes, limited(2000), scratch / "keys");
  const Samples samples = observe(first, Restless(), 500);
  const AnimationState state = first.state();
  std::filesystem::remove(scratch / "keys");
  Animation second(kTypes, limited(2000), scratch / "keys");
  CHECK_FALSE(second.restore(state));
  second.observe(7, samples.values.back());
  CHECK(second.tracks(8, samples.values.back())[0].front().time == 7);
}

TEST_CASE("a state of the future that has become another is not taken for it") {
  const ScratchFolder scratch;
  Animation animation(kTypes, limited(2000), scratch / "keys");
  observe(animation, Restless(), 100);
  const AnimationState early = animation.state();
  Restless one;
  for (int i = 0; i < 100; ++i) animation.observe(1 + 0.01 * i, one.at_next());
  const AnimationState late = animation.state();
  REQUIRE(animation.restore(early));
  for (int i = 0; i < 100; ++i) animation.observe(1 + 0.01 * i, {Value{}, {0, 0, 0, 1}, Value{}});
  animation.observe(3, one.at_next());
  animation.state();
  CHECK_FALSE(animation.restore(late));
}

TEST_CASE("the size of a state does not grow with the time") {
  const ScratchFolder scratch;
  const auto size_after = [&](int samples) {
    Animation animation(kTypes, limited(2000), scratch / "keys");
    observe(animation, Restless(), samples);
    std::vector<std::uint8_t> bytes;
    stride::StateWriter writer(bytes);
    animation.state().write(writer);
    return bytes.size();
  };
  CHECK(size_after(10) == size_after(5000));
}

TEST_CASE("a switch has the instant of a double, or the last float before it") {
  CHECK(time_of_keyframe(0) == 0);
  CHECK(time_of_keyframe(0.5) == 0.5F);
  for (const double time : {0.1, 14.2, 3599.9, 1e-7}) {
    const float seconds = time_of_keyframe(time);
    CHECK(double{seconds} <= time);
    CHECK(double{std::nextafter(seconds, std::numeric_limits<float>::max())} > time);
  }
}
