#include "master/checks/signal_check.h"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "master/util/time_text.h"

namespace stride::checks {

SignalCheck::SignalCheck(const Definition& definition)
    : Check(definition),
      demand_(std::get<SignalDemand>(definition.what)),
      good_(definition.kind == Kind::Never ? Truth::False : Truth::True),
      kept_(core::ValueType::Boolean, 1) {}

void SignalCheck::attach(const core::Signal& signal) {
  block_ = signal.block;
  at_ = signal.first + demand_.element;
  kept_ = core::ValueBlock(block_->type(), 1);
}

void SignalCheck::on_point(Time time) {
  if (decided_at_ || after_) return;
  last_ = time;
  const Truth truth = demand_.condition.holds(*block_, at_);
  if (!window().has_begun(time)) {
    before_ = truth;
  } else if (window().is_past(time)) {
    after_ = truth;
  } else {
    ++points_;
    judge(time, truth);
  }
}

void SignalCheck::judge(Time time, Truth truth) {
  switch (definition().kind) {
    case Kind::Eventually:
      keep(truth);
      if (is_good(truth)) decided_at_ = time;
      break;
    case Kind::Final:
      keep(truth);
      break;
    default:
      extend_range();
      if (is_good(truth)) break;
      keep(truth);
      decided_at_ = time;
  }
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
  const auto persist_truth = [&](std::optional<Truth>& truth) {
    bool is_known = truth.has_value();
    state.value(is_known);
    if (!is_known) return truth.reset();
    if (!truth) truth = Truth::False;
    state.value(*truth, Truth::NotANumber);
  };
  persist_truth(before_);
  persist_truth(after_);
  state.value(points_);
  state.value(decided_at_);
  state.value(last_);
  core::persist(state, kept_);
  state.value(kept_truth_, Truth::NotANumber);
  state.value(least_);
  state.value(most_);
}

core::Verdict SignalCheck::verdict(const Ending& ending) const {
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
    return make(true, fmt::format("at {} communication points", points_));
  }
  const std::string unit = demand_.unit.empty() ? "" : " " + demand_.unit;
  return make(true, fmt::format("it was between {:.6g}{} and {:.6g}{}", least_, unit, most_, unit));
}

/// No communication point in the interval: what held on both sides of it held there, too.
core::Verdict SignalCheck::unseen_verdict() const {
  const bool is_known = before_ && after_ && is_good(*before_) && is_good(*after_);
  return make(is_known ? std::optional(true) : std::nullopt,
              is_known ? "at the communication points before and after the interval"
                       : "there was no communication point in the interval");
}

std::string SignalCheck::kept_text() const { return demand_.condition.value_text(kept_, 0); }

}  // namespace stride::checks
