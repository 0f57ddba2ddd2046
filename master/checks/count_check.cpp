#include "master/checks/count_check.h"

#include <fmt/format.h>

namespace stride::checks {

CountCheck::CountCheck(const Definition& definition)
    : Check(definition), demand_(std::get<CountDemand>(definition.what)) {}

void CountCheck::on_message(const core::Message& message) {
  if (message.id != demand_.event || !window().contains(message.time)) return;
  ++count_;
  if (!exceeded_at_ && demand_.max && count_ > *demand_.max) exceeded_at_ = message.time;
}

core::Verdict CountCheck::verdict(const Ending& ending) const {
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

std::string CountCheck::text() const {
  return count_ == 1 ? "1 message" : fmt::format("{} messages", count_);
}

}  // namespace stride::checks
