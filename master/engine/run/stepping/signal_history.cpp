#include "master/engine/run/stepping/signal_history.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "master/base/state_archive.h"

namespace stride::core {
namespace {

/// Of a step: samples that are closer to each other do not both count. A slope's error is that of
/// the values times at most this, over a step.
constexpr int kLeastSpacing = 1000;

}  // namespace

SignalHistory::SignalHistory(std::size_t signals, unsigned degree)
    : signals_(signals), degree_(degree) {
  assert(degree <= kMaxDegree);
  for (Sample& sample : samples_) sample.values.resize(signals);
}

std::span<double> SignalHistory::add(Time time) {
  assert(count_ == 0 || samples_[newest_].time < time);
  newest_ = (newest_ + 1) % kSamples;
  count_ = std::min<unsigned>(count_ + 1, kSamples);
  samples_[newest_].time = time;
  return samples_[newest_].values;
}

void SignalHistory::remove_newest() {
  assert(count_ > 0);
  newest_ = index(1);
  --count_;
}

void SignalHistory::persist(StateArchive& state, Time oldest, Time newest) {
  state.value(count_);
  if (count_ == 0 || count_ > kSamples) state.fail("there are fewer samples, or more, than can be");
  if (state.is_reading()) newest_ = count_ - 1;
  Time least = oldest;
  for (unsigned age = count_; age-- > 0;) {
    Sample& sample = samples_[index(age)];
    state.value(sample.time);
    if (sample.time < least || sample.time > newest) state.fail("a sample is not in its turn");
    least = sample.time + Duration(1);
    state.fixed(sample.values);
  }
  if (samples_[newest_].time != newest) state.fail("the newest sample is missing");
}

/// Those of the polynomial; their weights are still open.
SignalHistory::Weights SignalHistory::choose_samples(Duration step) const {
  assert(count_ > 0);
  Weights chosen;
  chosen.count = 1;
  for (unsigned age = 1; age < count_ && chosen.count <= degree_; ++age) {
    const Time newer = samples_[index(chosen.age[chosen.count - 1])].time;
    if (newer - samples_[index(age)].time >= step / kLeastSpacing) chosen.age[chosen.count++] = age;
  }
  return chosen;
}

SignalHistory::Weights SignalHistory::at(Time origin, double seconds_after, Duration step) const {
  Weights weights = choose_samples(step);
  std::array<double, kMaxDegree + 1> nodes{};
  for (unsigned k = 0; k < weights.count; ++k) {
    nodes[k] = to_seconds(samples_[index(weights.age[k])].time - origin);
  }
  for (unsigned k = 0; k < weights.count; ++k) {
    weights.of[k] = 1;
    for (unsigned j = 0; j < weights.count; ++j) {
      if (j != k) weights.of[k] *= (seconds_after - nodes[j]) / (nodes[k] - nodes[j]);
    }
  }
  return weights;
}

/// By Gauss's two points, which are exact up to the third degree.
SignalHistory::Weights SignalHistory::mean(Time from, Time to) const {
  const double half = to_seconds(to - from) / 2;
  const double offset = half / std::sqrt(3.0);
  Weights weights = at(from, half - offset, to - from);
  const Weights second = at(from, half + offset, to - from);
  for (unsigned k = 0; k < weights.count; ++k) {
    weights.of[k] = (weights.of[k] + second.of[k]) / 2;
  }
  return weights;
}

}  // namespace stride::core
