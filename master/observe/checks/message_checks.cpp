#include "master/observe/checks/message_checks.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/observe/checks/difference.h"

namespace stride::checks {
namespace {

std::string requests(std::uint64_t count) { return core::counted(count, "request"); }

}  // namespace

AnswerCheck::AnswerCheck(const Definition& definition)
    : Check(definition), demand_(std::get<AnswerDemand>(definition.what)) {}

void AnswerCheck::on_message(const core::Message& message) {
  if (message.id == demand_.reply) {
    expire_before(message.time);
    add_reply(message.time);
  } else if (message.id == demand_.request && window().contains(message.time)) {
    expire_before(message.time);
    add_request(message.time);
  }
}

void AnswerCheck::on_point(Time time) {
  last_ = time;
  expire_before(later(time, Duration(1)));
}

void AnswerCheck::expire_before(Time time) {
  while (!open_.empty() && deadline(open_.front()) < time) {
    if (!unanswered_) unanswered_ = open_.front();
    // of repeated requests the first one is the latest
    if (!demand_.repeats || late_.empty()) late_.push_back(open_.front());
    open_.erase(open_.begin());
  }
}

void AnswerCheck::add_request(Time time) {
  if (demand_.repeats && !open_.empty()) return;
  ++requests_;
  open_.push_back(time);
}

void AnswerCheck::add_reply(Time time) {
  if (demand_.repeats || open_.empty()) add_late_reply(time);
  if (open_.empty()) return;
  ++answered_;
  slowest_ = std::max(slowest_, time - open_.front());
  extend_margin(deadline(open_.front()) - time, time);
  open_.erase(open_.begin());
}

void AnswerCheck::add_late_reply(Time time) {
  if (late_.empty()) return;
  extend_margin(deadline(late_.front()) - time, time);
  late_.pop_front();
}

void AnswerCheck::extend_margin(Duration margin, Time time) {
  if (margin >= margin_) return;
  margin_ = margin;
  margin_at_ = time;
}

void AnswerCheck::persist(core::StateArchive& state) {
  state.values(open_);
  state.sequence(late_, [&](Time& request) { state.value(request); });
  state.value(requests_);
  state.value(answered_);
  state.value(slowest_);
  state.value(unanswered_);
  state.value(last_);
  state.value(margin_);
  state.value(margin_at_);
}

/// A request that was never answered is late by what the run has shown of it.
core::Margin AnswerCheck::margin(const Ending& ending) const {
  if (!late_.empty()) {
    // a run that fails amid its events may have seen a later instant than it has reached
    const Duration shown = std::min(deadline(late_.front()) - ending.reached, Duration{});
    if (shown < margin_) return {to_seconds(shown), "s", ending.reached};
  }
  return {to_seconds(margin_), "s", margin_at_};
}

core::Verdict AnswerCheck::judged(const Ending& ending) const {
  if (unanswered_) return unanswered_verdict();
  if (!open_.empty()) {
    return make(std::nullopt, fmt::format("the request at {} s was still open where the run ended, "
                                          "at {} s; {} of {} answered",
                                          core::to_text(open_.front()),
                                          core::to_text(ending.reached), answered_, requests_));
  }
  if (!last_ || !is_over(*last_, ending)) return cut_short(ending);
  if (requests_ == 0) return make(std::nullopt, "there was no request");
  return make(true, fmt::format("{} answered, after {} s at most", requests(requests_),
                                core::to_text(slowest_)));
}

core::Verdict AnswerCheck::unanswered_verdict() const {
  return failed(deadline(*unanswered_),
                fmt::format("no reply to the request at {} s; {} of {} answered in time",
                            core::to_text(*unanswered_), answered_, requests(requests_)));
}

CountCheck::CountCheck(const Definition& definition)
    : Check(definition), demand_(std::get<CountDemand>(definition.what)) {}

void CountCheck::on_message(const core::Message& message) {
  if (message.id != demand_.event || !window().contains(message.time)) return;
  ++count_;
  if (!exceeded_at_ && demand_.max && count_ > *demand_.max) exceeded_at_ = message.time;
}

void CountCheck::persist(core::StateArchive& state) {
  state.value(count_);
  state.value(exceeded_at_);
  state.value(last_);
}

core::Margin CountCheck::margin(const Ending& ending) const {
  double least = std::numeric_limits<double>::infinity();
  if (demand_.max) least = difference(*demand_.max, count_);
  if (demand_.min) least = std::min(least, difference(count_, *demand_.min));
  return {least, "messages", std::min(end(ending), ending.reached)};
}

core::Verdict CountCheck::judged(const Ending& ending) const {
  if (exceeded_at_) {
    return failed(*exceeded_at_, fmt::format("message number {}; expected {} at most",
                                             *demand_.max + 1, *demand_.max));
  }
  const bool has_enough = !demand_.min || count_ >= *demand_.min;
  if (has_enough && !demand_.max) return make(true, text());
  if (!last_ || !is_over(*last_, ending)) return cut_short(ending);
  if (has_enough) return make(true, text());
  return failed(end(ending), fmt::format("{}; expected {} at least", text(), *demand_.min));
}

std::string CountCheck::text() const { return core::counted(count_, "message"); }

}  // namespace stride::checks
