#include "master/study/compare/signals/signal_tally.h"

#include <cmath>

#include <stride/value_text.h>

namespace stride::compare {

/// Whether it is the first one so far.
bool SignalTally::count(Time time) {
  ++difference_.count;
  if (difference_.time && *difference_.time <= time) return false;
  difference_.time = time;
  return true;
}

std::string SignalTally::text(double value) const {
  if (is_boolean_) return value != 0 ? "true" : "false";
  std::string text;
  append_value(text, value);
  return text;
}

void SignalTally::widen(std::optional<Extreme>& extreme, double value, Time time, double a,
                        double b) {
  if (!std::isfinite(value) || (extreme && extreme->value >= value)) return;
  extreme = {value, time, text(a), text(b)};
}

void SignalTally::add(Time time, double a, double b) {
  if (count(time)) {
    difference_.a = text(a);
    difference_.b = text(b);
  }
  if (is_boolean_) return;
  const double distance = std::abs(a - b);
  widen(difference_.absolute, distance, time, a, b);
  if (b != 0) widen(difference_.relative, distance / std::abs(b), time, a, b);
}

void SignalTally::add(Time time, const std::string& a, const std::string& b) {
  if (!count(time)) return;
  difference_.a = a;
  difference_.b = b;
}

std::optional<Difference> SignalTally::difference() const {
  if (difference_.count == 0) return std::nullopt;
  return difference_;
}

}  // namespace stride::compare
