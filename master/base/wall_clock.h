// How long the units take, in wall-clock time.
#ifndef STRIDE_MASTER_BASE_WALL_CLOCK_H
#define STRIDE_MASTER_BASE_WALL_CLOCK_H

#include <chrono>
#include <utility>

namespace stride::core {

/// Adds up durations, or, where nothing is to be measured, does not look at the time at all.
class WallClock {
 public:
  using Source = std::chrono::steady_clock;

  explicit WallClock(bool measures) : measures_(measures) {}

  bool measures() const { return measures_; }
  void measure(bool measures) { measures_ = measures; }

  /// Runs the action and adds the time that it took, also where it throws, to the sum.
  template <class Action>
  decltype(auto) timed(std::chrono::nanoseconds& sum, Action&& action) const {
    struct Adder {
      std::chrono::nanoseconds* sum;
      Source::time_point began;
      ~Adder() {
        if (sum != nullptr) *sum += Source::now() - began;
      }
    };
    const Adder adder = measures_ ? Adder{&sum, Source::now()} : Adder{nullptr, {}};
    return std::forward<Action>(action)();
  }

 private:
  bool measures_;
};

}  // namespace stride::core

#endif
