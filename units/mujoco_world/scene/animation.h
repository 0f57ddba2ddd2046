// What is animated in a scene: poses that move, and what is switched.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_ANIMATION_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_ANIMATION_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <stride/unit/state.h>

#include "units/mujoco_world/scene/keyframe_log.h"
#include "units/mujoco_world/scene/track.h"

namespace mujoco_world::scene {

struct AnimationLimits {
  double tolerance = 1e-6;          ///< to begin with [m, rad]
  double most_tolerance = 1e-2;     ///< beyond which samples are left out
  std::size_t keyframes = 500'000;  ///< of all tracks
  double interval = 0.1;            ///< between samples, about [s]
};

/// All that a state of an animation consists of, but for its keyframes.
struct AnimationState {
  LogPosition position;
  std::uint64_t samples = 0;
  double last_time = -1;  ///< of the samples; -1: there is none
  double tolerance = 0;
  double resolution = 0;
  std::vector<MovingTrack> moving;  ///< of each track; those that switch have none
  std::vector<Value> switched;      ///< the last value of those

  void write(stride::StateWriter& writer) const;
  void read(stride::StateReader& reader);
};

/// The keyframes of some tracks, by samples of them in the course of time, bounded in number: where
/// they get too many the tolerance is doubled until those that are there, thinned, are at most half
/// as many. Where that does not help because too much is switched, or moves too far between
/// samples, samples of a resolution in time are taken: the first one in each such piece of time.
class Animation {
 public:
  /// `file` is for the keyframes of its states.
  Animation(std::vector<TrackType> tracks, const AnimationLimits& limits,
            std::filesystem::path file);

  void clear();

  /// What is at a time [s], not before that of the last sample: a value for each track. Where its
  /// first number is NaN it is not known.
  void observe(double time, const std::vector<Value>& values);

  /// The keyframes of each track, with `values` at `time` as the last ones. The keyframes of a
  /// track of which there is one, or that does not move, are the first one alone.
  std::vector<std::vector<TimedValue>> tracks(double time, const std::vector<Value>& values) const;

  /// Within which the samples are [m, rad].
  double tolerance() const { return state_.tolerance; }
  /// The shortest time between samples that count [s]; 0: all do.
  double resolution() const { return state_.resolution; }
  std::uint64_t samples() const { return state_.samples; }

  /// With the keyframes in the file.
  AnimationState state();
  /// False if the keyframes of that time are gone: it goes on without them.
  bool restore(const AnimationState& state);

 private:
  bool is_passed_over(double time) const;
  void observe_switch(std::size_t track, const TimedValue& sample);
  void thin();

  std::vector<TrackType> tracks_;
  AnimationLimits limits_;
  KeyframeLog log_;
  AnimationState state_;
};

/// The latest instant that a float has which is not after the time.
float time_of_keyframe(double time);

}  // namespace mujoco_world::scene

#endif
