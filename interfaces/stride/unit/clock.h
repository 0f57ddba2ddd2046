#ifndef STRIDE_UNIT_CLOCK_H
#define STRIDE_UNIT_CLOCK_H

#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include <stride/time.h>

namespace stride {

/// When a clock ticks (FMI 3.0, 2.2.8): by the time, in the manner of the enumerator, or
/// triggered.
enum class IntervalVariability : std::uint8_t {
  Constant,
  Fixed,
  Tunable,
  Changing,
  Countdown,
  Triggered,
};

/// A clock of a unit (FMI 3.0, 2.2.8): the instant at which something happens, separate from its
/// value. It is triggered, unless its row in the variable table has another variability.
///
/// A triggered output: the unit calls tick() in step() or event(); the importer sees the tick in
/// the Event Mode that follows, and the kit withdraws it when that super-dense instant is over. An
/// input has ticked during the update_outputs() before event() and during event() if the importer
/// set it in this super-dense instant, as it does with a time-based clock at the times that the
/// unit gave.
class Clock {
 public:
  void tick() { ticked_ = 1; }
  bool ticked() const { return ticked_ != 0; }
  void clear() { ticked_ = 0; }

  /// Of a periodic clock: from tick to tick, as it is declared, or as the importer or the unit has
  /// set it. Of a changing or countdown clock: what count_down() set last.
  Duration interval() const { return interval_; }
  /// Of a periodic clock: from the start to the first tick.
  Duration shift() const { return shift_; }

  /// For a fixed or tunable clock that is declared without an interval: sets it, in initialize();
  /// a tunable one also in event(), from which on the new interval counts.
  void set_interval(Duration interval) {
    if (interval <= Duration{}) throw std::invalid_argument("a clock's interval must be positive");
    if (knowledge_ == Knowledge::None || interval != interval_) knowledge_ = Knowledge::New;
    interval_ = interval;
  }
  /// The same for the time to its first tick, in initialize().
  void set_shift(Duration shift) {
    if (shift < Duration{}) throw std::invalid_argument("a clock's shift must not be negative");
    shift_ = shift;
  }

  /// For a countdown or changing clock: it ticks once, `interval` from now on, in the place of an
  /// earlier count that has not ended. In initialize(), from the start on, or in event(); a
  /// changing clock in each event() in which it ticks, and in no other. A count of 0 ticks in
  /// another super-dense instant of the same time.
  void count_down(Duration interval) {
    if (interval < Duration{}) throw std::invalid_argument("a clock counts down from 0 at least");
    interval_ = interval;
    knowledge_ = Knowledge::New;
  }

 private:
  friend class ClockAccess;
  /// What the importer has read of the interval: nothing yet, not the present one, all.
  enum class Knowledge : std::uint64_t { None, New, Reported };

  Duration interval_{};
  Duration shift_{};
  std::uint64_t ticked_ = 0;
  Knowledge knowledge_ = Knowledge::None;
};

// a saved state holds its bytes, so there must be none without a meaning
static_assert(std::has_unique_object_representations_v<Clock>);

}  // namespace stride

#endif
