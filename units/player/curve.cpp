#include "units/player/curve.h"

#include <algorithm>
#include <cmath>

namespace player {
namespace {

std::size_t place_in(const std::vector<stride::Time>& times,
                     std::vector<stride::Time>::const_iterator found) {
  return static_cast<std::size_t>(found - times.begin());
}

}  // namespace

double Curve::magnitude() const {
  double most = 0;
  for (const double value : values_) most = std::max(most, std::abs(value));
  return most;
}

/// On the line to the point `next`, from the one before it.
Curve::Place Curve::between(std::size_t next, stride::Time time) const {
  if (next == 0) return {values_.front(), 0};
  if (next == times_.size()) return {values_.back(), 0};
  const double from = values_[next - 1];
  const double size = stride::to_seconds(times_[next] - times_[next - 1]);
  const double slope = (values_[next] - from) / size;
  if (time == times_[next - 1]) return {from, slope};
  return {from + slope * stride::to_seconds(time - times_[next - 1]), slope};
}

Curve::Place Curve::at(stride::Time time) const {
  return between(place_in(times_, std::upper_bound(times_.begin(), times_.end(), time)), time);
}

double Curve::before(stride::Time time) const {
  const std::size_t place = place_in(times_, std::lower_bound(times_.begin(), times_.end(), time));
  if (place < times_.size() && times_[place] == time) return values_[place];
  return between(place, time).value;
}

std::optional<stride::Time> Curve::next(stride::Time time) const {
  const auto found = std::upper_bound(times_.begin(), times_.end(), time);
  return found == times_.end() ? std::nullopt : std::optional(*found);
}

bool Curve::ends_with_jump() const {
  const std::size_t size = times_.size();
  return size > 1 && times_[size - 1] == times_[size - 2] && values_[size - 1] != values_[size - 2];
}

}  // namespace player
