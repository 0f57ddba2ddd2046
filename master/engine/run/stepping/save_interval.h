// How many steps a unit makes between two saves of its state.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_SAVE_INTERVAL_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_SAVE_INTERVAL_H

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "master/base/wall_clock.h"

namespace stride::core {

/// A rollback behind k steps since the last save repeats up to k - 1 of them, on average (k - 1)/2.
/// With s the cost of a save, c that of a step and p the share of the steps that are rolled back,
/// s/k + p c (k - 1)/2 per step is least at k = sqrt(2 s / (p c)), the first-order optimum of
/// J. W. Young, "A first order approximation to the optimum checkpoint interval", 1974; for states
/// that are saved periodically in optimistic simulation see Y.-B. Lin and E. D. Lazowska, 1990. The
/// costs are wall-clock times of a sample, p is what has happened lately. A save that costs no more
/// than to note what the unit is given is made before each step.
class SaveInterval {
 public:
  using Cost = std::chrono::nanoseconds;
  using Now = WallClock::Source::time_point (*)();
  /// What it costs to note what is given in a step [ns]. These are those of one unit by itself.
  struct NoteCosts {
    double near = 50;      ///< where the caches of the processor have room for it
    double cramped = 100;  ///< where they have room for a few steps only
    double far = 150;      ///< where it goes to memory

    NoteCosts operator*(double factor) const {
      return {near * factor, cramped * factor, far * factor};
    }
  };

  /// `most`: no interval is longer [steps]. `adapts`: begins with 1; otherwise it is always `most`.
  /// `now`: the clock that saves and steps are measured with.
  SaveInterval(std::size_t most, bool adapts, Now now = &WallClock::Source::now);

  /// A save begins a stretch of at most as many steps as are returned.
  std::size_t begin_stretch() {
    is_measured_ = is_next_measured();
    ++stretches_;
    if (is_measured_) [[unlikely]]
      choose();
    return chosen_;
  }
  /// Likewise, but only a stretch of one step that is not measured: whether it has begun.
  bool begin_single_step() {
    if (chosen_ != 1 || is_next_measured()) return false;
    is_measured_ = false;
    ++stretches_;
    return true;
  }
  /// Whether that save, and the first step of the stretch, are to be measured.
  bool is_measured() const { return is_measured_; }
  Now now() const { return now_; }
  void add_costs(Cost save, Cost step);

  /// Whether a save, as far as it was measured, costs less than to note so many steps of units by
  /// themselves. Never, if it does not adapt.
  bool is_save_cheaper(std::size_t steps) const {
    return adapts_ && save_cost_ < NoteCosts{}.near * static_cast<double>(steps);
  }
  void set_note_costs(const NoteCosts& costs) { note_costs_ = costs; }

  void count_step() { ++steps_; }
  void count_rollback() { ++rollbacks_; }

  /// No interval is longer from now on.
  void limit(std::size_t most) {
    most_ = std::clamp<std::size_t>(most, 1, most_);
    chosen_ = std::min(chosen_, most_);
  }
  std::size_t most() const { return most_; }
  /// What is noted of so many steps has room in the caches of the processor. To note more of them
  /// costs more, and is worthwhile where saves do.
  void set_near(std::size_t steps) { near_ = std::max<std::size_t>(steps, 1); }

 private:
  /// One stretch of so many is measured; of the first ones, more. Powers of two.
  static constexpr std::size_t kMeasured = 128, kMeasuredEarly = 16, kEarly = 512;

  bool is_next_measured() const {
    const std::size_t measured = stretches_ + 1 < kEarly ? kMeasuredEarly : kMeasured;
    return adapts_ && ((stretches_ + 1) & (measured - 1)) == 0;
  }
  void choose();
  double best() const;

  std::size_t most_;
  std::size_t near_;
  bool adapts_;
  Now now_;
  bool is_measured_ = false;
  std::size_t chosen_;
  std::size_t stretches_ = 0;
  NoteCosts note_costs_;
  double save_cost_ = 0, step_cost_ = 0;   ///< moving averages [ns]; 0 = not measured yet
  std::size_t steps_ = 0, rollbacks_ = 0;  ///< lately
};

}  // namespace stride::core

#endif
