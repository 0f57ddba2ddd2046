#include "master/algorithm/stepping/step_size.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/util/time_text.h"

namespace stride::core {
namespace {

constexpr double kSafety = 0.9;
constexpr double kLeastShrink = 0.1;
constexpr double kShrink = 0.2;
constexpr double kGrow = 5;
constexpr double kLeastRatio = 1e-4;  // smaller errors are as good as none

Duration scaled(Duration duration, double factor) {
  return Duration(static_cast<std::int64_t>(static_cast<double>(duration.count()) * factor));
}

}  // namespace

StepSize::StepSize(const System& system, const RunOptions& options)
    : system_(system),
      options_(options.step),
      start_(options.start),
      stop_(options.stop),
      grid_point_(options.start),
      order_(1.0 + static_cast<double>(options.extrapolation)),
      maximum_(options.step.maximum),
      size_(options.step.size) {
  if (options.step.size <= Duration{})
    throw std::invalid_argument("the step size must be positive");
  if (controls_error() && !maximum_) maximum_ = std::max((stop_ - start_) / 10, Duration(1));
  for (const Component& component : system.components()) {
    const UnitDescription& unit = *component.description;
    if (unit.maximum_step)
      maximum_ = std::min(maximum_.value_or(stop_ - start_), *unit.maximum_step);
    if (unit.fixed_internal_step) refine_quantum(*unit.fixed_internal_step);
  }
  check_units(system);
}

/// Where no multiple of all internal steps lies within the run, those that came first count.
void StepSize::refine_quantum(Duration internal) {
  if (internal <= Duration{}) return;
  const std::int64_t factor = internal.count() / std::gcd(quantum_.count(), internal.count());
  std::int64_t multiple = 0;
  if (__builtin_mul_overflow(quantum_.count(), factor, &multiple)) return;
  if (Duration(multiple) <= stop_ - start_) quantum_ = Duration(multiple);
}

void StepSize::check_units(const System& system) const {
  const bool varies =
      options_.policy != StepPolicy::Fixed || (maximum_ && *maximum_ < options_.size);
  std::vector<std::string> rigid;
  std::vector<std::string> final;
  for (const Component& component : system.components()) {
    if (!component.description->can_vary_step) rigid.push_back(component.name);
    if (!component.can_save_state()) final.push_back(component.name);
  }
  if (varies && !rigid.empty()) {
    fail_input({},
               fmt::format("these units take steps of one size only: {}; the policy '{}' with "
                           "these step sizes needs various ones",
                           quoted(rigid), name(options_.policy)),
               "use the policy 'fixed', with a step no longer than any unit's maximum");
  }
  if (controls_error() && !final.empty()) {
    fail_input({},
               fmt::format("these units cannot be rolled back: {}; the policy '{}' has to undo "
                           "steps that were too long",
                           quoted(final), name(options_.policy)),
               "let them have processes of their own, whose snapshots take them back, <stride:Host "
               "components=\"…\" process=\"true\"/>, or use units that can save their state "
               "(canGetAndSetFMUState), or another policy");
  }
}

Time StepSize::next(Time now) {
  Time target = stop_;
  if (options_.policy == StepPolicy::Fixed) {
    const Duration since = now == grid_point_ ? Duration{} : (now - start_) % options_.size;
    if (stop_ - now > options_.size - since) target = now + (options_.size - since);
    grid_point_ = target;
    if (maximum_ && target - now > *maximum_) target = now + *maximum_;
    return target;
  }
  const Duration longest =
      controls_error() ? std::min(size_, *maximum_) : maximum_.value_or(stop_ - now);
  if (stop_ - now > longest) target = on_internal_grid(now + longest, now);
  return target;
}

Time StepSize::stride(Time now, Time quiet_until) {
  const Time regular = next(now);
  Time farthest = std::min(quiet_until, stop_);
  if (maximum_ && farthest - now > *maximum_) farthest = now + *maximum_;
  if (farthest <= regular || options_.policy != StepPolicy::Fixed) return regular;
  if (farthest == stop_) return stop_;
  grid_point_ = farthest - (farthest - start_) % options_.size;
  return grid_point_;
}

Time StepSize::on_internal_grid(Time time, Time now) const {
  const Time before = time - (time - start_) % quantum_;
  if (before > now) return before;
  const Time after = std::min(stop_, before + quantum_);
  return maximum_ && after - now > *maximum_ ? time : after;
}

bool StepSize::accept(Time from, Time reached, const Excess& excess) {
  const Duration used = reached - from;
  if (used == Duration{}) return true;
  if (excess.ratio > 1) {
    const Duration least = std::max(options_.minimum, quantum_);
    if (used <= least) fail_tolerance(from, reached, excess);
    const double factor = kSafety * std::pow(excess.ratio, -1 / order_);
    size_ = std::max(least, scaled(used, std::max(kLeastShrink, factor)));
    was_rejected_ = true;
    return false;
  }
  const double ratio = std::max(excess.ratio, kLeastRatio);
  const double factor =
      kSafety * std::pow(ratio, -0.7 / order_) * std::pow(previous_ratio_, 0.4 / order_);
  const Duration wanted = scaled(used, std::clamp(factor, kShrink, was_rejected_ ? 1 : kGrow));
  // a step that an event cut short says nothing against a longer one
  size_ = std::min(used < size_ ? std::max(size_, wanted) : wanted, *maximum_);
  size_ = std::max(size_, options_.minimum);
  previous_ratio_ = ratio;
  was_rejected_ = false;
  return true;
}

void StepSize::fail_tolerance(Time from, Time reached, const Excess& excess) const {
  const bool is_grid = quantum_ > options_.minimum;
  fail_run(
      {{},
       system_.components()[excess.output.component].name,
       system_.variable(excess.output).name,
       from},
      fmt::format("over a step of {} s the output changes by {:.3g} times what the inputs that "
                  "it feeds may be off by, and no shorter step is {}",
                  to_text(reached - from), excess.ratio,
                  is_grid ? fmt::format("possible, since steps end on the units' fixed internal "
                                        "steps (fixedInternalStepSize) of {} s",
                                        to_text(quantum_))
                          : "allowed"),
      is_grid ? "loosen the tolerances, or export the unit with a smaller internal step"
              : "loosen the tolerances, allow a smaller minimum step, or let the unit announce the "
                "jump as an event");
}

}  // namespace stride::core
