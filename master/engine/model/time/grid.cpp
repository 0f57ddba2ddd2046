#include "master/engine/model/time/grid.h"

#include <algorithm>

namespace stride::core {
namespace {

/// A billionth of a step; at least a picosecond where that is not more than a millionth.
Duration negligible_part(Duration step) {
  constexpr Duration kLeast = std::chrono::microseconds(1);
  return step < kLeast ? Duration{} : std::max(step / 1'000'000'000, Duration(1));
}

}  // namespace

Grid::Grid(Time start, const Interval& step)
    : start_(start),
      step_(std::min(step, Interval::from_seconds(kMaxSeconds))),
      is_whole_(step_.is_whole()),
      denominator_(step_.parts().denominator),
      regular_(step_.rounded()),
      negligible_(negligible_part(regular_)),
      deviation_(is_whole_ ? negligible_ : std::max(negligible_, Duration(1))),
      ratio_(step_.ratio()) {
  const Interval::Parts parts = step_.parts();
  const Wide numerator = Wide{parts.numerator_high} << 64 | parts.numerator_low;
  whole_ = numerator / denominator_;
  fraction_ = static_cast<std::uint64_t>(numerator % denominator_);
}

Time Grid::fractional_point(std::uint64_t index) const {
  return tick_time(start_, {}, step_, index).value_or(Time::max());
}

/// No product is too wide: a step's numerator has 57 bits where its denominator is not 1.
std::uint64_t Grid::fractional_index(Wide since) const {
  const Wide numerator = whole_ * denominator_ + fraction_;
  const Wide most = (since + 1) * denominator_ - denominator_ / 2 - 1;
  return static_cast<std::uint64_t>(most / numerator);
}

bool Grid::ends_at(Time stop) const {
  const Duration rest = stop - last_point(stop);
  return rest <= negligible_ || is_regular(rest);
}

double Grid::point_seconds(Time time) const {
  const std::uint64_t index = index_at(time);
  return point(index) == time ? point_seconds(index) : to_seconds(time);
}

Grid::Walk::Walk(const Grid& grid, Time point)
    : grid_(grid), time_(point), index_(grid.index_at(point)) {
  const Wide begun = Wide{index_} * grid.fraction_ + grid.denominator_ / 2;
  rest_ = static_cast<std::uint64_t>(begun % grid.denominator_);
}

}  // namespace stride::core
