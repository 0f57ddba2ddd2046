#include "master/observe/checks/signal_check.h"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"

namespace stride::checks {

SignalCheck::SignalCheck(const Definition& definition)
    : Check(definition),
      demand_(std::get<SignalDemand>(definition.what)),
      good_(definition.kind == Kind::Never ? Truth::False : Truth::True),
      kept_(core::ValueType::Boolean, 1) {}

void SignalCheck::attach(std::span<const core::Signal> signals) {
  const core::Signal& signal = signals.front();
  block_ = signal.block;
  at_ = signal.first + demand_.element;
  kept_ = core::ValueBlock(block_->type(), 1);
}

SignalCheck::Point SignalCheck::present(Time time) const {
  const Judgement judgement = demand_.condition.judge(*block_, at_);
  const bool is_opposite = definition().kind == Kind::Never && judgement.truth != Truth::NotANumber;
  // no negative zero
  return {judgement.truth, is_opposite ? 0 - judgement.robustness : judgement.robustness, time};
}

void SignalCheck::on_point(Time time) {
  if (after_) return;
  last_ = time;
  const Point point = present(time);
  if (!window().has_begun(time)) {
    before_ = point;
  } else if (window().is_past(time)) {
    after_ = point;
  } else {
    ++points_;
    extend_margin(point);
    if (!decided_at_) judge(point);
  }
}

void SignalCheck::judge(const Point& point) {
  switch (definition().kind) {
    case Kind::Eventually:
      keep(point.truth);
      if (is_good(point.truth)) decided_at_ = point.time;
      break;
    case Kind::Final:
      keep(point.truth);
      break;
    default:
      extend_range();
      if (is_good(point.truth)) break;
      keep(point.truth);
      decided_at_ = point.time;
  }
}

/// The first one of several that are the same.
void SignalCheck::extend_margin(const Point& point) {
  const Kind kind = definition().kind;
  const bool is_decisive = !decisive_ || kind == Kind::Final ||
                           (kind == Kind::Eventually ? point.robustness > decisive_->robustness
                                                     : point.robustness < decisive_->robustness);
  if (is_decisive) decisive_ = point;
}

void SignalCheck::keep(Truth truth) {
  core::copy_elements(kept_, 0, *block_, at_, 1);
  kept_truth_ = truth;
}

void SignalCheck::extend_range() {
  core::visit(*block_, [&](auto values) {
    using T = typename decltype(values)::value_type;
    if constexpr (std::is_arithmetic_v<T>) {
      least_ = std::min(least_, static_cast<double>(values[at_]));
      most_ = std::max(most_, static_cast<double>(values[at_]));
    }
  });
}

void SignalCheck::persist(core::StateArchive& state) {
  for (std::optional<Point>* const each : {&before_, &after_, &decisive_}) {
    state.optional(*each, [&](Point& point) {
      state.value(point.truth, Truth::NotANumber);
      state.value(point.robustness);
      state.value(point.time);
    });
  }
  state.value(points_);
  state.value(decided_at_);
  state.value(last_);
  core::persist(state, kept_);
  state.value(kept_truth_, Truth::NotANumber);
  state.value(least_);
  state.value(most_);
}

std::optional<core::SignalLimits> SignalCheck::limits() const {
  return core::SignalLimits{demand_.signal, window().from, window().to, demand_.condition.limits()};
}

/// At a communication point of the interval, or else at one of those
/// beside it, which both are as they should be.
core::Margin SignalCheck::margin(const Ending& /*ending*/) const {
  const Point& point =
      decisive_ ? *decisive_ : std::min(*before_, *after_, [](const Point& a, const Point& b) {
        return a.robustness < b.robustness;
      });
  return {point.robustness, demand_.unit, point.time};
}

core::Verdict SignalCheck::judged(const Ending& ending) const {
  switch (definition().kind) {
    case Kind::Final:
      if (!ending.is_complete || points_ == 0) return cut_short(ending);
      return is_good(kept_truth_) ? make(true, kept_text()) : bad(ending.reached);
    case Kind::Eventually:
      return eventual_verdict(ending);
    default:
      if (decided_at_) return bad(*decided_at_);
      if (!last_ || !is_over(*last_, ending)) return cut_short(ending);
      return points_ == 0 ? unseen_verdict() : lasting_verdict();
  }
}

core::Verdict SignalCheck::eventual_verdict(const Ending& ending) const {
  if (decided_at_) {
    return make(true, fmt::format("{} at {} s", kept_text(), core::to_text(*decided_at_)));
  }
  if (!last_ || !is_over(*last_, ending)) return cut_short(ending);
  return points_ == 0 ? unseen_verdict() : bad(end(ending));
}

core::Verdict SignalCheck::bad(Time time) const {
  const bool is_never = definition().kind == Kind::Never;
  core::Verdict verdict =
      failed(time, fmt::format("{}; expected {}{}", kept_text(), is_never ? "never " : "",
                               demand_.condition.text()));
  verdict.values.push_back({demand_.signal, kept_, demand_.unit});
  return verdict;
}

core::Verdict SignalCheck::lasting_verdict() const {
  if (least_ > most_ || block_->type() == core::ValueType::Boolean ||
      block_->type() == core::ValueType::Enumeration) {
    return make(true, "at " + core::counted(points_, "communication point"));
  }
  const std::string unit = demand_.unit.empty() ? "" : " " + demand_.unit;
  return make(true, fmt::format("it was between {:.6g}{} and {:.6g}{}", least_, unit, most_, unit));
}

/// No communication point in the interval: what held on both sides of it held there, too.
core::Verdict SignalCheck::unseen_verdict() const {
  const bool is_known = before_ && after_ && is_good(before_->truth) && is_good(after_->truth);
  return make(is_known ? std::optional(true) : std::nullopt,
              is_known ? "at the communication points before and after the interval"
                       : "there was no communication point in the interval");
}

std::string SignalCheck::kept_text() const { return demand_.condition.value_text(kept_, 0); }

}  // namespace stride::checks
