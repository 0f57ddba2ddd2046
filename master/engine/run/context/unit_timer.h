// The wall-clock time that units take in one phase of a run.
#ifndef STRIDE_MASTER_ENGINE_RUN_CONTEXT_UNIT_TIMER_H
#define STRIDE_MASTER_ENGINE_RUN_CONTEXT_UNIT_TIMER_H

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

#include "master/base/wall_clock.h"
#include "master/engine/run/context/statistics.h"

namespace stride::core {

/// Adds up in one of the times of UnitStatistics. The clock and the statistics must outlive it.
class UnitTimer {
 public:
  using Sum = std::chrono::nanoseconds UnitStatistics::*;

  UnitTimer(const WallClock& clock, std::vector<UnitStatistics>& statistics, Sum sum)
      : clock_(clock), statistics_(statistics), sum_(sum) {}

  template <class Action>
  decltype(auto) timed(std::size_t component, Action&& action) const {
    return clock_.timed(statistics_[component].*sum_, std::forward<Action>(action));
  }

 private:
  const WallClock& clock_;
  std::vector<UnitStatistics>& statistics_;
  Sum sum_;
};

}  // namespace stride::core

#endif
