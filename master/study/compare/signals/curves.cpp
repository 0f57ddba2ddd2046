#include "master/study/compare/signals/curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "master/study/compare/signals/value_window.h"
#include "master/study/compare/signals/values.h"

namespace stride::compare {
namespace {

/// The last row at this instant or before it; there is one.
std::size_t row_before(const Curve& curve, Time time) {
  const auto after = std::ranges::upper_bound(curve.times, time);
  return static_cast<std::size_t>(after - curve.times.begin()) - 1;
}

double held(const Curve& curve, Time time) { return number(curve.column, row_before(curve, time)); }

/// Between two values of which one is not finite there is no straight line.
double interpolated(const Curve& curve, Time time) {
  const std::size_t row = row_before(curve, time);
  const double from = number(curve.column, row);
  if (curve.times[row] == time || row + 1 == curve.times.size()) return from;
  const double to = number(curve.column, row + 1);
  if (!std::isfinite(from) || !std::isfinite(to)) return from;
  const double whole = to_seconds(curve.times[row + 1] - curve.times[row]);
  return std::lerp(from, to, to_seconds(time - curve.times[row]) / whole);
}

/// The rows of a curve within an interval that moves on.
class MovingInterval {
 public:
  MovingInterval(const Curve& curve, Duration tolerance)
      : times_(curve.times), tolerance_(tolerance) {}

  /// Times do not descend. Calls enter(row) and leave(row). Returns whether it reaches the curve.
  template <class Enter, class Leave>
  bool move_to(Time time, Enter&& enter, Leave&& leave) {
    if (times_.empty()) return false;
    begin_ = std::max(time - tolerance_, times_.front());
    end_ = std::min(time + tolerance_, times_.back());
    while (next_ < times_.size() && times_[next_] <= end_) enter(next_++);
    while (first_ < next_ && times_[first_] < begin_) leave(first_++);
    return begin_ <= end_;
  }
  Time begin() const { return begin_; }
  Time end() const { return end_; }

 private:
  std::span<const Time> times_;
  Duration tolerance_;
  Time begin_, end_;
  std::size_t first_ = 0, next_ = 0;
};

/// Calls differ(time, value, nearest value of the curve).
template <class IsAllowed, class Differ>
void compare_numbers(const Curve& rows, const Curve& curve, const CurveTolerances& tolerances,
                     IsAllowed&& is_allowed, Differ&& differ) {
  ValueWindow window;
  MovingInterval interval(curve, tolerances.time);
  for (std::size_t i = 0; i < rows.times.size(); ++i) {
    const bool is_near = interval.move_to(
        rows.times[i], [&](std::size_t row) { window.add(number(curve.column, row)); },
        [&](std::size_t row) { window.remove(number(curve.column, row)); });
    if (!is_near) continue;
    const auto at = tolerances.is_held ? &held : &interpolated;
    const double begin = at(curve, interval.begin());
    const double end = at(curve, interval.end());
    window.add(begin);
    window.add(end);
    const double value = number(rows.column, i);
    const double nearest = window.nearest(value, !tolerances.is_held);
    window.remove(begin);
    window.remove(end);
    if (!is_allowed(value, nearest)) differ(rows.times[i], value, nearest);
  }
}

/// Likewise, of texts: they are equal or not.
template <class Differ>
void compare_texts(const Curve& rows, const Curve& curve, const CurveTolerances& tolerances,
                   Differ&& differ) {
  std::map<std::string, std::size_t> window;
  MovingInterval interval(curve, tolerances.time);
  for (std::size_t i = 0; i < rows.times.size(); ++i) {
    const bool is_near = interval.move_to(
        rows.times[i], [&](std::size_t row) { ++window[curve.column.text(row)]; },
        [&](std::size_t row) {
          const auto left = window.find(curve.column.text(row));
          if (--left->second == 0) window.erase(left);
        });
    if (!is_near) continue;
    const std::string value = rows.column.text(i);
    const std::string begin = curve.column.text(row_before(curve, interval.begin()));
    if (value != begin && !window.contains(value)) differ(rows.times[i], value, begin);
  }
}

}  // namespace

void compare_curves(const Curve& a, const Curve& b, const CurveTolerances& tolerances,
                    SignalTally& tally) {
  const auto add = [&](Time time, const auto& mine, const auto& other) {
    tally.add(time, mine, other);
  };
  const auto add_swapped = [&](Time time, const auto& mine, const auto& other) {
    tally.add(time, other, mine);
  };
  if (!are_numbers(a.column, b.column)) {
    if (!tolerances.only_rows_of_b) compare_texts(a, b, tolerances, add);
    return compare_texts(b, a, tolerances, add_swapped);
  }
  const Tolerance& value = tolerances.value;
  if (!tolerances.only_rows_of_b) {
    compare_numbers(
        a, b, tolerances, [&](double mine, double other) { return value.allows(mine, other); },
        add);
  }
  compare_numbers(
      b, a, tolerances, [&](double mine, double other) { return value.allows(other, mine); },
      add_swapped);
}

}  // namespace stride::compare
