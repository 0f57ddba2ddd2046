// The interval of a clock, exact however often it is repeated.
#ifndef STRIDE_MASTER_MODEL_INTERVAL_H
#define STRIDE_MASTER_MODEL_INTERVAL_H

#include <cstdint>
#include <optional>

#include <stride/time.h>

namespace stride::core {

class StateArchive;

/// A length of time as a fraction of picoseconds. A double represents the shortest decimal that
/// reads back as that double, so 0.1 s is a tenth of a second, and its millionth multiple is exact.
class Interval {
  __extension__ using Wide = unsigned __int128;

 public:
  /// Zero.
  Interval() = default;
  /// counter / resolution seconds. Throws std::invalid_argument for the resolution 0, and for a
  /// fraction that does not fit (denominator in ps above 2^62).
  static Interval from_fraction(std::uint64_t counter, std::uint64_t resolution);
  /// Above kMaxSeconds, or infinite: longer than any simulation.
  /// Throws std::invalid_argument for what is negative or not a number.
  static Interval from_seconds(double seconds);
  static Interval from_duration(Duration duration);

  bool operator==(const Interval&) const = default;
  /// Whether it is none that was read from damaged memory: all others are fractions.
  bool is_fraction() const { return denominator_ != 0; }
  bool is_zero() const { return numerator_ == 0; }
  bool is_below_picosecond() const { return numerator_ < denominator_; }
  void persist(StateArchive& state);

  /// The fraction of picoseconds, for a copy elsewhere. One with the denominator 0 is none.
  struct Parts {
    std::uint64_t numerator_high, numerator_low, denominator;
  };
  Parts parts() const {
    return {static_cast<std::uint64_t>(numerator_ >> 64), static_cast<std::uint64_t>(numerator_),
            denominator_};
  }
  static Interval from_parts(const Parts& parts) {
    Interval interval;
    interval.numerator_ = Wide{parts.numerator_high} << 64 | parts.numerator_low;
    interval.denominator_ = parts.denominator;
    return interval;
  }

  /// The nearest double, for display [s].
  double seconds() const;

 private:
  friend std::optional<Time> tick_time(Time, const Interval&, const Interval&, std::uint64_t);

  Interval(Wide numerator, std::uint64_t denominator);

  Wide numerator_ = 0;  ///< the fraction is reduced
  std::uint64_t denominator_ = 1;
};

/// base + shift + count * interval, rounded once, to the nearest picosecond; nothing if that is
/// later than any Time.
std::optional<Time> tick_time(Time base, const Interval& shift, const Interval& interval,
                              std::uint64_t count);

}  // namespace stride::core

#endif
