#include "master/checks/answer_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::checks {
namespace {

std::string requests(std::uint64_t count) {
  return count == 1 ? "1 request" : fmt::format("{} requests", count);
}

}  // namespace

AnswerCheck::AnswerCheck(const Definition& definition)
    : Check(definition), demand_(std::get<AnswerDemand>(definition.what)) {}

void AnswerCheck::on_message(const core::Message& message) {
  if (message.id == demand_.reply) {
    expire_before(message.time);
    answer(message.time);
  } else if (message.id == demand_.request && window().contains(message.time)) {
    expire_before(message.time);
    ask(message.time);
  }
}

void AnswerCheck::on_point(Time time) {
  last_ = time;
  expire_before(later(time, Duration(1)));
}

void AnswerCheck::expire_before(Time time) {
  while (!open_.empty() && deadline(open_.front()) < time) {
    if (!unanswered_) unanswered_ = open_.front();
    open_.erase(open_.begin());
  }
}

void AnswerCheck::ask(Time time) {
  if (demand_.repeats && !open_.empty()) return;
  ++requests_;
  open_.push_back(time);
}

void AnswerCheck::answer(Time time) {
  if (open_.empty()) return;
  ++answered_;
  slowest_ = std::max(slowest_, time - open_.front());
  open_.erase(open_.begin());
}

core::Verdict AnswerCheck::verdict(const Ending& ending) const {
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
                                core::to_text(Time(slowest_))));
}

core::Verdict AnswerCheck::unanswered_verdict() const {
  return failed(deadline(*unanswered_),
                fmt::format("no reply to the request at {} s; {} of {} answered in time",
                            core::to_text(*unanswered_), answered_, requests(requests_)));
}

}  // namespace stride::checks
