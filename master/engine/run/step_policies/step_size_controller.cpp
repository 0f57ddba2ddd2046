#include "master/engine/run/step_policies/step_size_controller.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "master/base/state_archive.h"

namespace stride::core {
namespace {

constexpr double kSafety = 0.9;
constexpr double kLeastShrink = 0.1;
constexpr double kShrink = 0.2;
constexpr double kGrow = 5;
constexpr double kLeastRatio = 1e-4;  // smaller errors are as good as none

Duration scaled(Duration duration, double factor) {
  return Duration(static_cast<Picoseconds>(static_cast<double>(duration.count()) * factor));
}

}  // namespace

void StepSizeController::reject(Duration used, double ratio, Duration least) {
  const double factor = kSafety * std::pow(ratio, -1 / order_);
  size_ = std::max(least, scaled(used, std::max(kLeastShrink, factor)));
  was_rejected_ = true;
}

void StepSizeController::accept(Duration used, double ratio, const Range& range) {
  const double counted = std::max(ratio, kLeastRatio);
  const double factor =
      kSafety * std::pow(counted, -0.7 / order_) * std::pow(previous_ratio_, 0.4 / order_);
  const Duration wanted = scaled(used, std::clamp(factor, kShrink, was_rejected_ ? 1 : kGrow));
  // a step that an event cut short is no reason for a shorter one
  size_ = std::min(used < size_ ? std::max(size_, wanted) : wanted, range.maximum);
  size_ = std::max(size_, range.minimum);
  previous_ratio_ = counted;
  was_rejected_ = false;
}

void StepSizeController::persist(StateArchive& state) {
  state.mark("step size");
  state.value(size_);
  state.value(previous_ratio_);
  state.value(was_rejected_);
  const bool is_ratio = previous_ratio_ >= kLeastRatio && previous_ratio_ <= 1;  // not of NaN
  if (size_ <= Duration{} || !is_ratio) state.fail("no step can have led to it");
}

}  // namespace stride::core
