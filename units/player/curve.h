// A course of straight lines over time.
#ifndef STRIDE_UNITS_PLAYER_CURVE_H
#define STRIDE_UNITS_PLAYER_CURVE_H

#include <cstddef>
#include <optional>
#include <vector>

#include <stride/time.h>

namespace player {

/// Two points of one time are a jump. Before the first point and behind the last one the value is
/// held.
class Curve {
 public:
  struct Place {
    double value;
    double slope;  ///< [1/s] behind that instant
  };

  /// Not before the points that there are.
  void add(stride::Time time, double value) { times_.push_back(time), values_.push_back(value); }
  bool is_empty() const { return times_.empty(); }
  double first() const { return values_.front(); }
  double last() const { return values_.back(); }
  /// The greatest distance from 0.
  double magnitude() const;
  /// At a jump: where it leads.
  Place at(stride::Time time) const;
  /// At a jump: where it begins.
  double before(stride::Time time) const;
  /// The next point after that instant.
  std::optional<stride::Time> next(stride::Time time) const;
  /// Whether the last two points are of one time, and differ.
  bool ends_with_jump() const;

 private:
  Place between(std::size_t next, stride::Time time) const;

  std::vector<stride::Time> times_;
  std::vector<double> values_;
};

}  // namespace player

#endif
