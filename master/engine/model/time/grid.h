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
 public:
  /// The step is one picosecond at least.
  Grid(Time start, const Interval& step);

  Time start() const { return start_; }
  /// Whether each point is a whole number of picoseconds before it is rounded.
  bool is_whole() const { return is_whole_; }
  const Interval& step() const { return step_; }

  /// Time::max() if it would be later than that.
  Time point(std::uint64_t index) const {
    return is_whole_ ? whole_point(index) : fractional_point(index);
  }
  /// The last point that is not later than a time, which is not before the start.
  std::uint64_t index_at(Time time) const {
    const auto since = static_cast<std::uint64_t>((time - start_).count());
    return is_whole_ ? since / whole_ : fractional_index(since);
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

  /// Goes from point to point of a grid that is_whole(), by one addition.
  class WholeWalk {
   public:
    /// From a point.
    WholeWalk(const Grid& grid, Time point) : time_(point), size_(grid.regular_) {}

    Time time() const { return time_; }
    double seconds() const { return to_seconds(time_); }
    void advance() { time_ += size_; }

   private:
    Time time_;
    const Duration size_;
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
      time_ += Duration(static_cast<std::int64_t>(grid_.whole_ + carries));
    }

   private:
    const Grid& grid_;
    Time time_;
    std::uint64_t index_;
    std::uint64_t rest_;  ///< of the point before it was rounded down, half a picosecond added
  };

 private:
  Time whole_point(std::uint64_t index) const {
    std::int64_t count = 0;
    if (__builtin_mul_overflow(index, whole_, &count)) return Time::max();
    return later(start_, Duration(count));
  }
  Time fractional_point(std::uint64_t index) const;
  std::uint64_t fractional_index(std::uint64_t since) const;
  double point_seconds(Time time) const;
  double point_seconds(std::uint64_t index) const {
    return to_seconds(start_) + static_cast<double>(index) * ratio_.numerator / ratio_.denominator;
  }

  Time start_;
  Interval step_;
  bool is_whole_;
  std::uint64_t whole_;  ///< of the step, in picoseconds: whole_ + fraction_ / denominator_
  std::uint64_t fraction_;
  std::uint64_t denominator_;
  Duration regular_;
  Duration negligible_;
  Duration deviation_;  ///< from regular_, of a regular step
  Interval::Ratio ratio_;
};

}  // namespace stride::core

#endif
