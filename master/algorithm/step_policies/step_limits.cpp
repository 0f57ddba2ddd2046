#include "master/algorithm/step_policies/step_limits.h"

#include <algorithm>
#include <numeric>

namespace stride::core {

StepLimits::StepLimits(const System& system, const RunOptions& options,
                       std::optional<Duration> default_maximum)
    : start_(options.start),
      stop_(options.stop),
      maximum_(options.step.maximum ? options.step.maximum : default_maximum) {
  for (const Component& component : system.components()) {
    const UnitDescription& unit = *component.description;
    if (unit.maximum_step)
      maximum_ = std::min(maximum_.value_or(stop_ - start_), *unit.maximum_step);
    if (unit.fixed_internal_step) refine_quantum(*unit.fixed_internal_step);
  }
}

/// Where no multiple of all internal steps lies within the run, those that came first count.
void StepLimits::refine_quantum(Duration internal) {
  if (internal <= Duration{}) return;
  const std::int64_t factor = internal.count() / std::gcd(quantum_.count(), internal.count());
  std::int64_t multiple = 0;
  if (__builtin_mul_overflow(quantum_.count(), factor, &multiple)) return;
  if (Duration(multiple) <= stop_ - start_) quantum_ = Duration(multiple);
}

Time StepLimits::end_of_step(Time now, Duration size) const {
  if (stop_ - now <= size) return stop_;
  const Time time = now + size;
  const Time before = time - (time - start_) % quantum_;
  if (before > now) return before;
  const Time after = std::min(stop_, before + quantum_);
  return maximum_ && after - now > *maximum_ ? time : after;
}

}  // namespace stride::core
