#include "master/engine/run/stepping/save_interval.h"

#include <algorithm>
#include <cmath>

namespace stride::core {
namespace {

/// Nothing is chosen before so many stretches were made.
constexpr std::size_t kWarmUp = 64;
/// What happened so many steps ago counts half.
constexpr std::size_t kMemory = 4096;
/// Where the caches have no room for the notes of so many steps, they have none for the rest that
/// they take, either.
constexpr std::size_t kFewNear = 16;

/// A moving average over the last eight or so. An interruption of the machine counts as little more
/// than the rest.
void add_to_average(double& average, double value) {
  average = average == 0 ? value : average + (std::min(value, 4 * average) - average) / 8;
}

}  // namespace

SaveInterval::SaveInterval(std::size_t most, bool adapts, Now now)
    : most_(most),
      near_(most),
      adapts_(adapts && most > 1),
      now_(now),
      chosen_(adapts ? 1 : most) {}

void SaveInterval::choose() {
  if (steps_ > kMemory) {
    steps_ /= 2;
    rollbacks_ /= 2;
  }
  if (stretches_ < kWarmUp) return;
  chosen_ = static_cast<std::size_t>(std::clamp(best(), 1.0, static_cast<double>(most_)));
  if (save_cost_ <= note_costs_.far * static_cast<double>(near_))
    chosen_ = std::min(chosen_, near_);
}

void SaveInterval::add_costs(Cost save, Cost step) {
  add_to_average(save_cost_, static_cast<double>(std::max(save, Cost(1)).count()));
  add_to_average(step_cost_, static_cast<double>(std::max(step, Cost(1)).count()));
}

/// That no step was rolled back yet does not mean that none will be.
double SaveInterval::best() const {
  if (save_cost_ <= (near_ < kFewNear ? note_costs_.cramped : note_costs_.near)) return 1;
  const double share = static_cast<double>(rollbacks_ + 1) / static_cast<double>(steps_ + 1);
  return std::sqrt(2 * save_cost_ / (share * step_cost_));
}

}  // namespace stride::core
