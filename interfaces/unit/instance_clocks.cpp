// The time-based clocks of an instance (FMI 3.0, 2.2.8).
#include <stdexcept>

#include "interfaces/unit/clock_access.h"
#include "interfaces/unit/instance.h"

namespace stride::kit {

Duration duration_of_fraction(std::uint64_t counter, std::uint64_t resolution) {
  __extension__ using Wide = unsigned __int128;
  if (resolution == 0) throw Misuse("the resolution is 0");
  const Wide picoseconds =
      (Wide{counter} * Wide{Duration::period::den} + resolution / 2) / resolution;
  if (picoseconds / Duration::period::den > static_cast<Wide>(kMaxSeconds)) {
    throw Misuse("the interval " + std::to_string(counter) + " / " + std::to_string(resolution) +
                 " s is longer than any simulation");
  }
  return Duration(static_cast<Picoseconds>(picoseconds));
}

const Variable& Instance::time_based_clock(fmi3ValueReference reference) const {
  slot(reference, Type::Clock);
  const Variable& row = table_->row(reference);
  if (is_time_based(row)) return row;
  throw Misuse("clock '" + row.name + "' is triggered, so it has no interval and no shift");
}

const Variable& Instance::periodic_clock(fmi3ValueReference reference) const {
  const Variable& row = time_based_clock(reference);
  if (is_periodic(row)) return row;
  throw Misuse("clock '" + row.name + "' is a " + name(row.interval_variability) +
               " clock, only periodic ones have a shift");
}

/// Whose interval and shift the importer may choose.
const Variable& Instance::adjustable_clock(fmi3ValueReference reference) const {
  const Variable& row = time_based_clock(reference);
  const bool adjustable = row.interval_variability == IntervalVariability::Fixed ||
                          row.interval_variability == IntervalVariability::Tunable;
  if (adjustable && row.has_interval) return row;
  throw Misuse("clock '" + row.name + "' is a " + name(row.interval_variability) + " clock" +
               (adjustable ? " whose interval the unit determines"
                           : ", only the intervals of fixed and tunable ones can be set"));
}

Clock& Instance::clock_of(const Variable& row) { return *static_cast<Clock*>(row.data); }

Instance::ClockInterval Instance::clock_interval(fmi3ValueReference reference) {
  const Variable& row = time_based_clock(reference);
  refresh();
  Clock& clock = clock_of(row);
  if (row.has_interval) return {clock.interval(), fmi3IntervalUnchanged};
  const bool is_fixed = row.interval_variability == IntervalVariability::Fixed;
  if (is_fixed && mode_ == EventMode && ClockAccess::has_news(clock)) {
    throw std::logic_error("clock '" + row.name +
                           "' is fixed, but its interval changed after the start");
  }
  const fmi3IntervalQualifier qualifier = ClockAccess::report(clock);
  const bool may_be_unknown = row.interval_variability == IntervalVariability::Countdown;
  if (qualifier == fmi3IntervalNotYetKnown && !may_be_unknown) {
    throw std::logic_error("the unit has not set the interval of its " +
                           std::string(name(row.interval_variability)) + " clock '" + row.name +
                           "'");
  }
  return {clock.interval(), qualifier};
}

Duration Instance::clock_shift(fmi3ValueReference reference) {
  const Variable& row = periodic_clock(reference);
  refresh();
  return clock_of(row).shift();
}

void Instance::check_clock_interval(fmi3ValueReference reference, Duration interval) const {
  const Variable& row = adjustable_clock(reference);
  if (interval <= Duration{}) {
    throw Misuse("clock '" + row.name + "' needs an interval of at least a picosecond");
  }
  if (row.interval_variability == IntervalVariability::Fixed && mode_ != InitializationMode) {
    throw Misuse("clock '" + row.name + "' is fixed, so its interval cannot be set in " +
                 mode_names(mode_) + ", only in " + mode_names(InitializationMode));
  }
}

void Instance::check_clock_shift(fmi3ValueReference reference, Duration shift) const {
  const Variable& row = adjustable_clock(reference);
  if (shift < Duration{}) throw Misuse("clock '" + row.name + "' cannot have a negative shift");
}

void Instance::set_clock_interval(fmi3ValueReference reference, Duration interval) {
  clock_of(table_->row(reference)).set_interval(interval);
  inputs_changed_ = true;
}

void Instance::set_clock_shift(fmi3ValueReference reference, Duration shift) {
  clock_of(table_->row(reference)).set_shift(shift);
  inputs_changed_ = true;
}

/// Before the unit sets its intervals from scratch.
void Instance::forget_intervals() {
  for (const Variable& row : unit_->variables()) {
    if (is_time_based(row) && !row.has_interval) ClockAccess::forget(clock_of(row));
  }
}

/// The importer set the clock; a count that was running has ended.
void Instance::activate(fmi3ValueReference reference) {
  const Variable& row = table_->row(reference);
  clock_of(row).tick();
  if (is_time_based(row) && !is_periodic(row)) ClockAccess::forget(clock_of(row));
}

}  // namespace stride::kit
