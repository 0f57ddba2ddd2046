#include "units/mujoco_world/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mujoco_world::scene {
namespace {

/// Of what a tolerance is raised by: thinning compares keyframes, and two ways that turn, within
/// MovingTrack::kLongestTurn, are up to 1 / cos(kLongestTurn / 4) farther apart between keyframes
/// than there.
constexpr double kThinning = 0.95;

bool is_known(const Value& value) { return !std::isnan(value[0]); }

bool differs(const Value& a, const Value& b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(double{a[i]} - double{b[i]}) > tolerance) return true;
  }
  return false;
}

double last_time_of(const MovingTrack& track) {
  return track.has_candidate ? track.candidate.time : track.keyframe.time;
}

using Timeline = std::vector<TimedValue>;

std::vector<Timeline> by_track(const std::vector<Keyframe>& keyframes, std::size_t count) {
  std::vector<Timeline> timelines(count);
  for (const Keyframe& keyframe : keyframes) {
    timelines[keyframe.track].push_back({keyframe.time, keyframe.value});
  }
  return timelines;
}

/// The first and the last one stay.
Timeline thinned_way(TrackType type, const Timeline& all, double tolerance) {
  Timeline kept;
  MovingTrack track;
  for (const TimedValue& keyframe : all) {
    if (const auto needed = track.observe(type, keyframe, tolerance)) kept.push_back(*needed);
  }
  if (track.has_candidate) kept.push_back(all.back());
  return kept;
}

/// The first and the last one stay, and of what moves the first, of what is switched the last one
/// in each piece of time.
Timeline one_in_each(TrackType type, const Timeline& all, double piece) {
  Timeline kept;
  const auto is_with = [&](std::size_t one, std::size_t other) {
    return other < all.size() &&
           std::floor(all[one].time / piece) == std::floor(all[other].time / piece);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_at_edge = i == 0 || i + 1 == all.size();
    const bool goes = type == TrackType::Switch ? is_with(i, i + 1) : i > 0 && is_with(i, i - 1);
    if (is_at_edge || !goes) kept.push_back(all[i]);
  }
  return kept;
}

std::size_t size_of(const std::vector<Timeline>& timelines) {
  std::size_t size = 0;
  for (const Timeline& timeline : timelines) size += timeline.size();
  return size;
}

}  // namespace

float time_of_keyframe(double time) {
  const auto nearest = static_cast<float>(time);
  return double{nearest} <= time ? nearest
                                 : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

void AnimationState::write(stride::StateWriter& writer) const {
  writer.write(position);
  writer.write(samples);
  writer.write(last_time);
  writer.write(tolerance);
  writer.write(resolution);
  writer.write(moving);
  writer.write(switched);
}

void AnimationState::read(stride::StateReader& reader) {
  reader.read(position);
  reader.read(samples);
  reader.read(last_time);
  reader.read(tolerance);
  reader.read(resolution);
  reader.read(moving);
  reader.read(switched);
}

Animation::Animation(std::vector<TrackType> tracks, const AnimationLimits& limits,
                     std::filesystem::path file)
    : tracks_(std::move(tracks)), limits_(limits), log_(std::move(file)) {
  state_.moving.resize(tracks_.size());
  state_.switched.resize(tracks_.size());
  state_.tolerance = limits_.tolerance;
}

void Animation::clear() {
  log_.clear();
  state_ = {};
  state_.tolerance = limits_.tolerance;
  state_.moving.resize(tracks_.size());
  state_.switched.resize(tracks_.size());
}

bool Animation::is_passed_over(double time) const {
  const double piece = state_.resolution;
  return piece > 0 && state_.last_time >= 0 &&
         std::floor(time / piece) == std::floor(state_.last_time / piece);
}

void Animation::observe(double time, const std::vector<Value>& values) {
  if (is_passed_over(time)) return;
  if (time > state_.last_time) ++state_.samples;
  state_.last_time = time;
  const float seconds = time_of_keyframe(time);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!is_known(values[i])) continue;
    const TimedValue sample{seconds, values[i]};
    if (tracks_[i] == TrackType::Switch) {
      observe_switch(i, sample);
      continue;
    }
    MovingTrack& track = state_.moving[i];
    if (track.has_keyframe && seconds <= last_time_of(track)) continue;
    if (const auto needed = track.observe(tracks_[i], sample, state_.tolerance)) {
      log_.add(static_cast<std::uint32_t>(i), needed->time, needed->value);
    }
  }
  if (log_.keyframes().size() > limits_.keyframes) thin();
}

void Animation::observe_switch(std::size_t track, const TimedValue& sample) {
  MovingTrack& known = state_.moving[track];
  const bool is_first = !std::exchange(known.has_keyframe, true);
  if (!is_first && !differs(sample.value, state_.switched[track], state_.tolerance)) return;
  known.moves = !is_first;
  state_.switched[track] = sample.value;
  log_.add(static_cast<std::uint32_t>(track), sample.time, sample.value);
}

void Animation::thin() {
  std::vector<Timeline> timelines = by_track(log_.keyframes(), tracks_.size());
  while (size_of(timelines) > limits_.keyframes / 2) {
    std::size_t moving = 0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i] != TrackType::Switch) moving += timelines[i].size();
    }
    if (moving > limits_.keyframes / 4 && state_.tolerance < limits_.most_tolerance) {
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        if (tracks_[i] == TrackType::Switch) continue;
        timelines[i] = thinned_way(tracks_[i], timelines[i], kThinning * state_.tolerance);
      }
      state_.tolerance *= 2;
    } else {
      state_.resolution = std::max(2 * state_.resolution, limits_.interval);
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        timelines[i] = one_in_each(tracks_[i], timelines[i], state_.resolution);
      }
    }
  }
  std::vector<Keyframe> keyframes;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (const TimedValue& kept : timelines[i]) {
      keyframes.push_back({static_cast<std::uint32_t>(i), kept.time, kept.value, 0});
    }
  }
  log_.replace(keyframes);
}

std::vector<Timeline> Animation::tracks(double time, const std::vector<Value>& values) const {
  std::vector<Timeline> timelines = by_track(log_.keyframes(), tracks_.size());
  const float seconds = time_of_keyframe(time);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Timeline& timeline = timelines[i];
    const TimedValue present{seconds, values[i]};
    MovingTrack track = state_.moving[i];
    if (tracks_[i] == TrackType::Switch) {
      const bool is_other =
          is_known(values[i]) &&
          (timeline.empty() || differs(values[i], timeline.back().value, state_.tolerance));
      if (is_other) timeline.push_back(present);
      continue;
    }
    const bool is_later = !track.has_keyframe || seconds > last_time_of(track);
    if (is_later && is_known(values[i])) {
      if (const auto needed = track.observe(tracks_[i], present, state_.tolerance)) {
        timeline.push_back(*needed);
      }
    }
    if (!track.moves) {
      timeline.resize(std::min<std::size_t>(timeline.size(), 1));
    } else if (track.has_candidate) {
      timeline.push_back(track.candidate);
    }
  }
  return timelines;
}

AnimationState Animation::state() {
  log_.keep();
  state_.position = log_.position();
  return state_;
}

bool Animation::restore(const AnimationState& state) {
  if (state.moving.size() != tracks_.size() || state.switched.size() != tracks_.size()) {
    throw std::runtime_error("the saved state is that of another world's scene");
  }
  if (!log_.go_back(state.position)) {
    clear();
    return false;
  }
  state_ = state;
  return true;
}

}  // namespace mujoco_world::scene
