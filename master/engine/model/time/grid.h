// Instants at equal distances: the communication points of fixed steps.
#ifndef STRIDE_MASTER_ENGINE_MODEL_TIME_GRID_H
#define STRIDE_MASTER_ENGINE_MODEL_TIME_GRID_H

#include <cstdint>

#include <stride/time.h>

#include "master/engine/model/time/interval.h"

namespace stride::core {

/// Point k is at start + k * step, rounded once to the picosecond, never at a sum of rounded steps.
/// So steps of 1/3 s meet each whole second, and their sizes differ by a picosecond at most.
class Grid {
  __extension__ using Wide = unsigned __int128;

 public:
  /// The step is one picosecond at least.
  Grid(Time start, const Interval& step);

  Time start() const { return start_; }
  const Interval& step() const { return step_; }

  /// Later than any stop time if it would be beyond kMaxSeconds.
  Time point(std::uint64_t index) const {
    return is_whole_ ? whole_point(index) : fractional_point(index);
  }
  /// The last point that is not later than a time, which is not before the start.
  std::uint64_t index_at(Time time) const {
    const auto since = static_cast<Wide>((time - start_).count());
    return is_whole_ ? static_cast<std::uint64_t>(since / whole_) : fractional_index(since);
  }
  Time last_point(Time time) const { return point(index_at(time)); }
  bool has(Time time) const { return last_point(time) == time; }

  /// Whether regular steps lead to this time.
  bool ends_at(Time stop) const;
  /// What a last step may be longer than the others, rather than that one of this size follows it.
  Duration negligible() const { return negligible_; }
  bool is_shorter(Duration size) const { return size < regular_ - deviation_; }
  /// Whether so long a step is a regular one.
  bool is_regular(Duration size) const {
    return size >= regular_ - deviation_ && size <= regular_ + deviation_;
  }

  /// The time as units are given it: the nearest double of a point before it was rounded, so that
  /// the end of a step is its beginning and step() in seconds, but for the rounding of doubles.
  double seconds(Time time) const { return is_whole_ ? to_seconds(time) : point_seconds(time); }
  double seconds(Duration size) const {
    return !is_whole_ && is_regular(size) ? step_.seconds() : to_seconds(size);
  }

  /// Whether so many steps from a point on are whole picoseconds that 64 bits can count.
  bool is_narrow(std::uint64_t steps, Time from) const {
    return is_whole_ && detail::is_narrow(start_.time_since_epoch().count()) &&
           detail::is_narrow(point(index_at(from) + steps).time_since_epoch().count());
  }

  /// Goes from point to point where is_narrow(), by one addition.
  class NarrowWalk {
   public:
    /// From a point.
    NarrowWalk(const Grid& grid, Time point)
        : count_(static_cast<std::int64_t>(point.time_since_epoch().count())),
          size_(static_cast<std::int64_t>(grid.regular_.count())) {}

    Time time() const { return Time(Duration(count_)); }
    double seconds() const { return static_cast<double>(count_) / 1e12; }
    void advance() { count_ += size_; }

   private:
    std::int64_t count_;  ///< of picoseconds
    const std::int64_t size_;
  };

  /// Goes from point to point of any grid, without a division.
  class Walk {
   public:
    /// From a point.
    Walk(const Grid& grid, Time point);

    Time time() const { return time_; }
    double seconds() const {
      return grid_.is_whole_ ? to_seconds(time_) : grid_.point_seconds(index_);
    }
    void advance() {
      ++index_;
      rest_ += grid_.fraction_;
      const bool carries = rest_ >= grid_.denominator_;
      if (carries) rest_ -= grid_.denominator_;
      time_ += Duration(static_cast<Picoseconds>(grid_.whole_ + carries));
    }

   private:
    const Grid& grid_;
    Time time_;
    std::uint64_t index_;
    std::uint64_t rest_;  ///< of the point before it was rounded down, half a picosecond added
  };

 private:
  Time whole_point(std::uint64_t index) const {
    Picoseconds count = 0;
    if (__builtin_mul_overflow(index, whole_, &count)) return Time::max();
    return later(start_, Duration(count));
  }
  Time fractional_point(std::uint64_t index) const;
  std::uint64_t fractional_index(Wide since) const;
  double point_seconds(Time time) const;
  double point_seconds(std::uint64_t index) const {
    return to_seconds(start_) + static_cast<double>(index) * ratio_.numerator / ratio_.denominator;
  }

  Time start_;
  Interval step_;
  bool is_whole_;
  Wide whole_;  ///< of the step, in picoseconds: whole_ + fraction_ / denominator_
  std::uint64_t fraction_;
  std::uint64_t denominator_;
  Duration regular_;
  Duration negligible_;
  Duration deviation_;  ///< from regular_, of a regular step
  Interval::Ratio ratio_;
};

}  // namespace stride::core

#endif
