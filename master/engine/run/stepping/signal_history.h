// The last values of some signals, and the polynomial through them.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_SIGNAL_HISTORY_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_SIGNAL_HISTORY_H

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <stride/time.h>

namespace stride::core {

class StateArchive;

/// Signals that were sampled together. Their polynomial goes through the newest samples, as many as
/// its degree requires, or as there are (Lagrange's form). Of samples that are much closer to each
/// other than the step that it is used for only the newest counts, since their slope is mostly
/// rounding error. Nothing allocates after construction.
class SignalHistory {
 public:
  static constexpr unsigned kMaxDegree = 2;

  /// What each sample counts for in a value of the polynomial, the newest first. They sum up to 1.
  struct Weights {
    std::array<double, kMaxDegree + 1> of{};
    std::array<unsigned, kMaxDegree + 1> age{};  ///< of the sample: how many are newer
    unsigned count = 0;
  };

  SignalHistory(std::size_t signals, unsigned degree);

  std::size_t signals() const { return signals_; }
  bool empty() const { return count_ == 0; }
  /// Of the newest sample; there must be one.
  Time newest() const { return samples_[newest_].time; }

  /// The place for a new sample, at a time after those before it.
  std::span<double> add(Time time);
  void remove_newest();
  void clear() { count_ = 0; }
  /// At least one sample, the newest of them at `newest`, none before `oldest`.
  void persist(StateArchive& state, Time oldest, Time newest);

  /// The weights for the value at a time in seconds after `origin`, within or at the end of a step
  /// of this length; there must be a sample.
  Weights at(Time origin, double seconds, Duration step) const;
  /// The weights for the mean value over an interval; that of the beginning if it has no length.
  Weights mean(Time from, Time to) const;

  /// The newest value, where the polynomial has none that is finite, as of a signal that is or was
  /// infinite.
  double value(std::size_t signal, const Weights& weights) const {
    double sum = 0;
    for (unsigned k = 0; k < weights.count; ++k) {
      sum += weights.of[k] * samples_[index(weights.age[k])].values[signal];
    }
    return std::isfinite(sum) ? sum : samples_[newest_].values[signal];
  }

 private:
  struct Sample {
    Time time{};
    std::vector<double> values;
  };
  // one more than the polynomial needs, so that the newest can be taken back
  static constexpr std::size_t kSamples = kMaxDegree + 2;

  Weights choose_samples(Duration step) const;
  /// Of the sample before the `age` newest.
  std::size_t index(unsigned age) const { return (newest_ + kSamples - age) % kSamples; }

  std::size_t signals_;
  unsigned degree_;
  std::array<Sample, kSamples> samples_;
  std::size_t newest_ = 0;
  unsigned count_ = 0;  ///< of valid samples
};

}  // namespace stride::core

#endif
