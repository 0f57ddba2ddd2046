#include "master/engine/run/step_policies/step_limits.h"

#include <algorithm>
#include <cstdint>

namespace stride::core {

StepLimits::StepLimits(const System& system, const RunOptions& options,
                       std::optional<Interval> default_maximum)
    : start_(options.start), stop_(options.stop) {
  std::optional<Interval> maximum = options.step.maximum ? options.step.maximum : default_maximum;
  for (const Component& component : system.components()) {
    if (component.keeps_own_step()) continue;
    const UnitDescription& unit = *component.description;
    if (unit.maximum_step) {
      maximum = std::min(maximum.value_or(Interval(stop_ - start_)), *unit.maximum_step);
    }
    if (unit.fixed_internal_step) refine_quantum(*unit.fixed_internal_step);
  }
  if (maximum) maximum_ = maximum->rounded();
}

/// Where no multiple of all internal steps lies within the run, those that came first count.
void StepLimits::refine_quantum(const Interval& internal) {
  const auto multiple = quantum_ ? common_multiple(quantum_->step(), internal) : internal;
  if (multiple && multiple->rounded() <= stop_ - start_) quantum_.emplace(start_, *multiple);
}

Time StepLimits::end_of_step(Time now, Duration size) const {
  if (stop_ - now <= size) return stop_;
  const Time time = now + size;
  if (!quantum_) return time;
  const std::uint64_t index = quantum_->index_at(time);
  if (const Time before = quantum_->point(index); before > now) return before;
  const Time after = std::min(stop_, quantum_->point(index + 1));
  return maximum_ && after - now > *maximum_ ? time : after;
}

}  // namespace stride::core
