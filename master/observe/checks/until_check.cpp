#include "master/observe/checks/until_check.h"

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::checks {
namespace {

const UntilDemand& until(const Definition& definition) {
  return std::get<UntilDemand>(definition.what);
}

}  // namespace

UntilCheck::UntilCheck(const Definition& definition)
    : Check(definition), holds_(until(definition).holds), ends_(until(definition).ends) {}

std::vector<core::VariableId> UntilCheck::signals() const {
  return {holds_.demand.id, ends_.demand.id};
}

void UntilCheck::attach(std::span<const core::Signal> signals) {
  const auto attach_side = [](Side& side, const core::Signal& signal) {
    side.block = signal.block;
    side.at = signal.first + side.demand.element;
    side.kept = core::ValueBlock(side.block->type(), 1);
  };
  attach_side(holds_, signals[0]);
  attach_side(ends_, signals[1]);
}

void UntilCheck::on_point(Time time) {
  if (last_ && window().is_past(*last_)) return;
  last_ = time;
  if (!window().contains(time)) return;
  ++points_;
  const Judgement holds = holds_.judge(), ends = ends_.judge();
  extend_margin(time, holds.robustness, ends.robustness);
  if (!decided_at_) judge(time, holds.truth, ends.truth);
}

void UntilCheck::judge(Time time, Truth holds, Truth ends) {
  for (Side* side : {&holds_, &ends_}) {
    core::copy_elements(side->kept, 0, *side->block, side->at, 1);
  }
  has_ended_ = ends == Truth::True;
  if (has_ended_ || holds != Truth::True) decided_at_ = time;
}

/// The first one of several that are the same.
void UntilCheck::extend_margin(Time time, double holds, double ends) {
  Distance here{ends, true, time};
  if (least_held_ && least_held_->robustness < ends) here = *least_held_;
  if (!best_ || here.robustness > best_->robustness) best_ = here;
  if (!least_held_ || holds < least_held_->robustness) least_held_ = {holds, false, time};
}

void UntilCheck::persist(core::StateArchive& state) {
  for (std::optional<Distance>* const each : {&least_held_, &best_}) {
    state.optional(*each, [&](Distance& distance) {
      state.value(distance.robustness);
      state.value(distance.is_of_end);
      state.value(distance.time);
    });
  }
  state.value(points_);
  state.value(decided_at_);
  state.value(has_ended_);
  state.value(last_);
  core::persist(state, holds_.kept);
  core::persist(state, ends_.kept);
}

core::Margin UntilCheck::margin(const Ending& /*ending*/) const {
  const Side& side = best_->is_of_end ? ends_ : holds_;
  return {best_->robustness, side.demand.unit, best_->time};
}

core::Verdict UntilCheck::judged(const Ending& ending) const {
  const std::string wanted = until(definition()).text();
  if (decided_at_ && !has_ended_) {
    return bad(*decided_at_, holds_,
               fmt::format("{} until {}", holds_.demand.condition.text(), wanted));
  }
  if (decided_at_) {
    return make(true, fmt::format("until {} s: {} was {}", core::to_text(*decided_at_),
                                  ends_.demand.signal, ends_.kept_text()));
  }
  if (!last_ || !is_over(*last_, ending)) return cut_short(ending);
  if (points_ == 0) return make(std::nullopt, "there was no communication point in the interval");
  return bad(end(ending), ends_, ends_.demand.condition.text());
}

core::Verdict UntilCheck::bad(Time time, const Side& side, const std::string& expected) const {
  core::Verdict verdict = failed(
      time, fmt::format("{} was {}; expected {}", side.demand.signal, side.kept_text(), expected));
  verdict.values.push_back({side.demand.signal, side.kept, side.demand.unit});
  return verdict;
}

}  // namespace stride::checks
