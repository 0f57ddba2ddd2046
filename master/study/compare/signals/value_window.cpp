#include "master/study/compare/signals/value_window.h"

#include <cmath>
#include <iterator>
#include <limits>

namespace stride::compare {

void ValueWindow::add(double value) {
  if (std::isnan(value)) {
    ++not_numbers_;
  } else {
    numbers_.insert(value);
  }
}

void ValueWindow::remove(double value) {
  if (std::isnan(value)) {
    --not_numbers_;
  } else {
    numbers_.erase(numbers_.find(value));
  }
}

double ValueWindow::nearest(double value, bool is_connected) const {
  if (numbers_.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (std::isnan(value)) return not_numbers_ > 0 ? value : *numbers_.begin();
  const auto above = numbers_.lower_bound(value);
  if (above == numbers_.end()) return *std::prev(above);
  if (above == numbers_.begin() || *above == value) return *above;
  const double below = *std::prev(above);
  if (is_connected && std::isfinite(below) && std::isfinite(*above)) return value;
  return *above - value < value - below ? *above : below;
}

}  // namespace stride::compare
