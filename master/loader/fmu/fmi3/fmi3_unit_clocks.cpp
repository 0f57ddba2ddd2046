// A unit's time-based clocks.
#include <stdexcept>

#include <fmt/format.h>

#include "master/loader/fmu/fmi3/fmi3_unit.h"

namespace stride::importer {

using core::ClockInterval;
using core::Interval;
using core::Variable;

/// Calls a function for one clock. Not every library has it.
template <class Function, class... Arguments>
void Fmi3Unit::call_clock(const char* name, Function* function, const Variable& clock,
                          Arguments... arguments) {
  if (function == nullptr) {
    core::fail_run({options_.where, name_, clock.name, time()},
                   fmt::format("its library does not export {}", name),
                   "a unit with such a time-based clock must have it");
  }
  call(name, function, &clock.reference, std::size_t{1}, arguments...);
}

/// What make() returns; its errors are errors of the unit.
template <class Make>
Interval Fmi3Unit::checked_interval(const char* function, const Variable& clock,
                                    Make&& make) const {
  try {
    return make();
  } catch (const std::invalid_argument& mistake) {
    core::fail_run({options_.where, name_, clock.name, time()},
                   fmt::format("{} gave no length of time: {}", function, mistake.what()));
  }
}

ClockInterval Fmi3Unit::clock_interval(const Variable& clock) {
  fmi3IntervalQualifier qualifier = fmi3IntervalNotYetKnown;
  const auto checked = [&](const char* function, auto&& make) -> ClockInterval {
    if (qualifier == fmi3IntervalNotYetKnown) return {};
    const bool changed = qualifier == fmi3IntervalChanged;
    return {changed ? ClockInterval::State::Changed : ClockInterval::State::Unchanged,
            checked_interval(function, clock, make)};
  };
  if (clock.clock->supports_fraction) {
    std::uint64_t counter = 0;
    std::uint64_t resolution = 0;
    const char* const function = "fmi3GetIntervalFraction";
    call_clock(function, fmi_.GetIntervalFraction, clock, &counter, &resolution, &qualifier);
    return checked(function, [&] { return Interval::from_fraction(counter, resolution); });
  }
  double seconds = 0;
  const char* const function = "fmi3GetIntervalDecimal";
  call_clock(function, fmi_.GetIntervalDecimal, clock, &seconds, &qualifier);
  return checked(function, [&] { return Interval::from_seconds(seconds); });
}

Interval Fmi3Unit::clock_shift(const Variable& clock) {
  if (clock.clock->supports_fraction) {
    std::uint64_t counter = 0;
    std::uint64_t resolution = 0;
    const char* const function = "fmi3GetShiftFraction";
    call_clock(function, fmi_.GetShiftFraction, clock, &counter, &resolution);
    return checked_interval(function, clock,
                            [&] { return Interval::from_fraction(counter, resolution); });
  }
  double seconds = 0;
  const char* const function = "fmi3GetShiftDecimal";
  call_clock(function, fmi_.GetShiftDecimal, clock, &seconds);
  return checked_interval(function, clock, [&] { return Interval::from_seconds(seconds); });
}

}  // namespace stride::importer
