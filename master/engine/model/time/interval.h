// A length of time, exact however often it is repeated: the interval of a clock, or a step size.
#ifndef STRIDE_MASTER_ENGINE_MODEL_TIME_INTERVAL_H
#define STRIDE_MASTER_ENGINE_MODEL_TIME_INTERVAL_H

#include <chrono>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <stride/time.h>

namespace stride::core {

class StateArchive;

/// A length of time as a fraction of picoseconds.
///
/// A double represents what a person meant by it: the shortest decimal that reads back as that
/// double, so 0.1 s is a tenth of a second; or, where that has 15 digits or more, the fraction that
/// was rounded to them, so 0.3333333333333333 s is a third.
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
  /// Throws std::invalid_argument for a negative one, as from_duration() does.
  template <class Count, class Period>
  Interval(std::chrono::duration<Count, Period> duration)  // NOLINT: each duration is an interval
      : Interval(from_duration(duration)) {}
  /// A decimal number of seconds, such as "14.2" or "1e-3". Throws as parse_seconds() does.
  static Interval parse(std::string_view seconds);

  bool operator==(const Interval&) const = default;
  std::strong_ordering operator<=>(const Interval& other) const;
  /// Whether it is none that was read from damaged memory: all others are fractions.
  bool is_fraction() const { return denominator_ != 0; }
  bool is_zero() const { return numerator_ == 0; }
  bool is_below_picosecond() const { return numerator_ < denominator_; }
  /// Whether it is a whole number of picoseconds.
  bool is_whole() const { return denominator_ == 1; }
  bool is_multiple_of(const Interval& other) const;
  /// The nearest whole number of picoseconds, at most Duration::max().
  Duration rounded() const;
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

  /// Seconds as a reduced fraction, exact below 2^53.
  struct Ratio {
    double numerator, denominator;
  };
  Ratio ratio() const;
  /// The nearest double [s].
  double seconds() const { return ratio().numerator / ratio().denominator; }

 private:
  friend std::optional<Time> tick_time(Time, const Interval&, const Interval&, std::uint64_t);
  friend std::optional<Interval> sum(const Interval&, const Interval&, std::uint64_t);
  friend std::optional<Interval> common_multiple(const Interval& a, const Interval& b);

  Interval(Wide numerator, std::uint64_t denominator);

  Wide numerator_ = 0;  ///< the fraction is reduced
  std::uint64_t denominator_ = 1;
};

/// base + shift + count * interval, rounded once, to the nearest picosecond; nothing if that is
/// later than any Time.
std::optional<Time> tick_time(Time base, const Interval& shift, const Interval& interval,
                              std::uint64_t count);

/// shift + count * interval; nothing if it does not fit.
std::optional<Interval> sum(const Interval& shift, const Interval& interval, std::uint64_t count);

/// The least interval that is a multiple of both, which are above 0; nothing if it does not fit.
std::optional<Interval> common_multiple(const Interval& a, const Interval& b);

/// Seconds: the exact decimal of a whole number of picoseconds, or else the shortest one that
/// represents the interval.
std::string to_text(const Interval& interval);

}  // namespace stride::core

#endif
