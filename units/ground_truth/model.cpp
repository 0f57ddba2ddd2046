#include "units/ground_truth/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "units/ground_truth/text.h"

namespace ground_truth {
namespace {

/// The shares of the tolerance and of the age that the history may be off by, to be short.
constexpr double kWidthShare = 1.0 / 64;
constexpr int kTimeShare = 16;

void require(bool ok, const std::string& what) {
  if (!ok) throw std::invalid_argument(what);
}

/// time - duration, or the first instant that there is if that is later.
stride::Time earlier(stride::Time time, stride::Duration duration) {
  return time < stride::Time::min() + duration ? stride::Time::min() : time - duration;
}

std::string seconds(stride::Time time) { return quantity_text(stride::to_seconds(time), "s"); }

}  // namespace

Judge::Judge(const Parameters& parameters, Quantity quantity) : quantity_(std::move(quantity)) {
  configure(parameters);
}

void Judge::configure(const Parameters& p) {
  require(p.tolerance >= 0.0 && std::isfinite(p.tolerance),
          "tolerance is " + quantity_text(p.tolerance, "") + ": expected 0 or more");
  require(p.max_age >= stride::Duration{}, "max_age is less than 0: expected 0 s or more");
  require(p.memory >= stride::Duration{}, "memory is less than 0: expected 0 s or more");
  parameters_ = p;
  history_.configure({p.tolerance * kWidthShare, p.max_age / kTimeShare}, p.memory);
}

Comparison Judge::compare(const Measurement& measurement) {
  require(std::isfinite(measurement.value), "the measured value is not a finite number");
  Comparison comparison;
  Deviation& deviation = comparison.deviation;
  deviation.received = measurement.received;
  deviation.measured = measurement.value;
  comparison.to = earlier(measurement.received, measurement.age);
  comparison.from =
      earlier(earlier(comparison.to, measurement.age_resolution), parameters_.max_age);
  if (const auto truth = history_.between(comparison.from, comparison.to)) {
    deviation.truth = std::clamp(measurement.value, truth->low, truth->high);
    deviation.error = measurement.value - deviation.truth;
    const bool is_right = std::abs(deviation.error) <= parameters_.tolerance;
    comparison.finding = is_right             ? Finding::Right
                         : truth->is_complete ? Finding::Wrong
                                              : Finding::Unknown;
  }
  count(comparison);
  return comparison;
}

void Judge::count(const Comparison& comparison) {
  if (comparison.finding == Finding::Unknown) {
    ++state_.unknown;
    return;
  }
  const bool is_first = compared() == 0;
  ++(comparison.finding == Finding::Right ? state_.right : state_.wrong);
  state_.last = comparison.deviation;
  if (is_first || std::abs(state_.last.error) > std::abs(state_.worst.error)) {
    state_.worst = state_.last;
  }
}

std::string Judge::verdict_text() const {
  const State& s = state_;
  std::string text = std::to_string(s.right) + " of " + std::to_string(compared()) +
                     (compared() == 1 ? " measurement right" : " measurements right");
  if (compared() < parameters_.minimum) {
    text += "; expected at least " + std::to_string(parameters_.minimum);
  }
  if (s.unknown > 0) text += "; " + std::to_string(s.unknown) + " too old to be checked";
  if (compared() == 0) return text;
  return text + "; worst error " + quantity_text(s.worst.error, quantity_.difference) + " at " +
         seconds(s.worst.received) + ": " + quantity_text(s.worst.measured, quantity_.unit) +
         " for " + quantity_text(s.worst.truth, quantity_.unit);
}

std::string Judge::text_of(const Comparison& comparison) const {
  const Deviation& deviation = comparison.deviation;
  const std::string measured = "measurement at " + seconds(deviation.received) + ": " +
                               quantity_text(deviation.measured, quantity_.unit);
  const std::string made = "between " + seconds(comparison.from) + " and " + seconds(comparison.to);
  if (comparison.finding == Finding::Unknown) {
    return measured + " was made " + made + ", of which the truth is not remembered; " +
           "it is not compared";
  }
  return measured + " is wrong, error " + quantity_text(deviation.error, quantity_.difference) +
         ", tolerance " + quantity_text(parameters_.tolerance, quantity_.difference) +
         "; the nearest truth " + made + " is " + quantity_text(deviation.truth, quantity_.unit);
}

}  // namespace ground_truth
