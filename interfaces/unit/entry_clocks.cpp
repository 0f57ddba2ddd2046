// The part of the FMI 3.0 entry table that is about time-based clocks (2.2.8 there).
#include "interfaces/unit/entry_call.h"
#include "interfaces/unit/fractions.h"

using stride::kit::call;
using stride::kit::duration_of_fraction;
using stride::kit::duration_of_seconds;
using stride::kit::fractions_of;
using stride::kit::Function;
using stride::kit::Instance;

namespace {

/// Sets intervals or shifts, all or none: duration(i) is the one for the clock references[i].
template <class Check, class Set, class Durations>
fmi3Status set_all(Instance& unit, const fmi3ValueReference references[], size_t count, Check check,
                   Set set, Durations&& duration) {
  for (size_t i = 0; i < count; ++i) (unit.*check)(references[i], duration(i));
  for (size_t i = 0; i < count; ++i) (unit.*set)(references[i], duration(i));
  return fmi3OK;
}

}  // namespace

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                                  size_t count, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  return call(instance, Function::GetIntervalDecimal, [&](Instance& unit) {
    for (size_t i = 0; i < count; ++i) unit.check_has_interval(references[i]);
    for (size_t i = 0; i < count; ++i) {
      const Instance::ClockInterval given = unit.clock_interval(references[i]);
      intervals[i] = stride::to_seconds(given.interval);
      qualifiers[i] = given.qualifier;
    }
    return fmi3OK;
  });
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                   size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[]) {
  return call(instance, Function::GetIntervalFraction, [&](Instance& unit) {
    for (size_t i = 0; i < count; ++i) unit.check_has_interval(references[i]);
    for (size_t i = 0; i < count; ++i) {
      const Instance::ClockInterval given = unit.clock_interval(references[i]);
      const auto fraction = fractions_of(given.interval);
      counters[i] = fraction.first;
      resolutions[i] = fraction.resolution;
      qualifiers[i] = given.qualifier;
    }
    return fmi3OK;
  });
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                               size_t count, fmi3Float64 shifts[]) {
  return call(instance, Function::GetShiftDecimal, [&](Instance& unit) {
    for (size_t i = 0; i < count; ++i)
      shifts[i] = stride::to_seconds(unit.clock_shift(references[i]));
    return fmi3OK;
  });
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
  return call(instance, Function::GetShiftFraction, [&](Instance& unit) {
    for (size_t i = 0; i < count; ++i) {
      const auto fraction = fractions_of(unit.clock_shift(references[i]));
      counters[i] = fraction.first;
      resolutions[i] = fraction.resolution;
    }
    return fmi3OK;
  });
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                                  size_t count, const fmi3Float64 intervals[]) {
  return call(instance, Function::SetIntervalDecimal, [&](Instance& unit) {
    return set_all(unit, references, count, &Instance::check_clock_interval,
                   &Instance::set_clock_interval,
                   [&](size_t i) { return duration_of_seconds(intervals[i]); });
  });
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                   size_t count, const fmi3UInt64 counters[],
                                   const fmi3UInt64 resolutions[]) {
  return call(instance, Function::SetIntervalFraction, [&](Instance& unit) {
    return set_all(unit, references, count, &Instance::check_clock_interval,
                   &Instance::set_clock_interval,
                   [&](size_t i) { return duration_of_fraction(counters[i], resolutions[i]); });
  });
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                               size_t count, const fmi3Float64 shifts[]) {
  return call(instance, Function::SetShiftDecimal, [&](Instance& unit) {
    return set_all(unit, references, count, &Instance::check_clock_shift,
                   &Instance::set_clock_shift,
                   [&](size_t i) { return duration_of_seconds(shifts[i]); });
  });
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                size_t count, const fmi3UInt64 counters[],
                                const fmi3UInt64 resolutions[]) {
  return call(instance, Function::SetShiftFraction, [&](Instance& unit) {
    return set_all(unit, references, count, &Instance::check_clock_shift,
                   &Instance::set_clock_shift,
                   [&](size_t i) { return duration_of_fraction(counters[i], resolutions[i]); });
  });
}
