#include "master/algorithm/idle/idle_ledger.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace stride::core {

IdleLedger::IdleLedger(const System& system, std::span<const std::unique_ptr<Unit>> units,
                       Exchange& exchange, std::vector<UnitStatistics>& statistics,
                       const Activities& activities, const IdleOptions& options)
    : system_(system),
      units_(units),
      exchange_(exchange),
      statistics_(statistics),
      activities_(activities),
      options_(options),
      accounts_(units.size()) {
  for (std::size_t i = 0; i < std::min(units.size(), options.max_skip.size()); ++i) {
    const std::optional<Duration>& max_skip = options.max_skip[i];
    if (max_skip && system.components()[i].description->promises_idle) open(i, *max_skip);
  }
}

void IdleLedger::open(std::size_t component, Duration max_skip) {
  candidates_.push_back(component);
  Account& account = accounts_[component];
  account.is_candidate = true;
  account.promises = &units_[component]->require_capability<IdlePromises>();
  account.max_skip = max_skip;
  for (const auto& [id, element] : exchange_.continuous_inputs(component)) {
    double deadband = system_.variable(id).deadband;
    for (const IdleSetting& setting : options_.deadbands) {
      if (setting.id == id) deadband = setting.value;
    }
    account.inputs.push_back({element, deadband});
  }
  std::size_t elements = 0;
  for (const auto& [id, element] : exchange_.outputs_with_tolerance(component)) {
    if (elements == account.tangents.size()) {
      account.references.push_back(system_.variable(id).reference);
      elements += system_.variable(id).size;
    }
    account.tangents.push_back({element});
  }
  account.slopes.resize(elements);
}

void IdleLedger::enable() {
  for (const std::size_t i : candidates_) {
    accounts_[i].promises->enable_idle_skipping(accounts_[i].max_skip);
  }
  for (const IdleSetting& setting : options_.tolerances) {
    if (!may_rest(setting.id.component)) continue;
    accounts_[setting.id.component].promises->set_idle_tolerances(
        {&system_.variable(setting.id).reference, 1}, {&setting.value, 1});
  }
}

std::optional<Time> IdleLedger::all_rest_until() const {
  if (candidates_.size() != accounts_.size()) return std::nullopt;
  Time earliest = Time::max();
  for (const Account& account : accounts_) {
    if (!account.rests) return std::nullopt;
    earliest = std::min(earliest, account.end);
  }
  return earliest;
}

Duration IdleLedger::rested(Time time) const {
  Duration sum{};
  for (const std::size_t i : candidates_) {
    sum += statistics_[i].rested;
    if (accounts_[i].rests) sum += time - accounts_[i].since;
  }
  return sum;
}

bool IdleLedger::wake(std::size_t component, Time time) {
  Account& account = accounts_[component];
  account.rests = false;
  const Duration debt = time - account.since;
  if (debt == Duration{}) return false;
  account.ended = time;
  const StepResult result = units_[component]->step({account.since, time});
  check_promise(component, time, result);
  exchange_.fetch(component, *units_[component]);
  UnitStatistics& statistics = statistics_[component];
  ++statistics.rests;
  statistics.rested += debt;
  statistics.longest_rest = std::max(statistics.longest_rest, debt);
  return result.event_needed;
}

void IdleLedger::tell_rest(std::size_t component) {
  Account& account = accounts_[component];
  const std::optional<Time> ended = std::exchange(account.ended, std::nullopt);
  if (ended) activities_.tell({component, Activity::Kind::Idle, account.since, *ended});
}

bool IdleLedger::wake_and_tell(std::size_t component, Time time) {
  const bool has_event = wake(component, time);
  tell_rest(component);
  return has_event;
}

void IdleLedger::tell_unfinished_rests(Time time) {
  for (const std::size_t i : candidates_) {
    Account& account = accounts_[i];
    if (std::exchange(account.rests, false) && account.since < time) account.ended = time;
    tell_rest(i);
  }
}

void IdleLedger::check_promise(std::size_t component, Time time, const StepResult& result) const {
  const Account& account = accounts_[component];
  const bool is_early_event = result.event_needed && time < account.until;
  if (!result.rejected && result.reached == time && !is_early_event) return;
  const std::string deed = result.rejected ? "rejects the step to there"
                           : result.reached != time
                               ? fmt::format("returns early at {} s", to_text(result.reached))
                               : "has an event";
  fail_run(
      {{}, system_.components()[component].name, {}, time},
      fmt::format(
          "the unit promised at {} s to be idle until {}, but {}", to_text(account.since),
          account.until == Time::max() ? "something disturbs it" : to_text(account.until) + " s",
          deed),
      "the promise is the unit's own fault; until it is mended, switch idle skipping off for "
      "it");
}

std::span<const std::size_t> IdleLedger::come_to(Time time) {
  events_.clear();
  for (const std::size_t i : candidates_) {
    Account& account = accounts_[i];
    if (!account.rests) continue;
    if (account.end <= time) {
      if (wake_and_tell(i, time)) events_.push_back(i);
      continue;
    }
    const double elapsed = to_seconds(time - account.since);
    for (const Tangent& tangent : account.tangents) {
      tangent.element.set(tangent.value + tangent.slope * elapsed);
    }
  }
  return events_;
}

bool IdleLedger::is_disturbed(const Account& account) const {
  return std::any_of(account.inputs.begin(), account.inputs.end(), [](const WatchedInput& input) {
    return !(std::abs(input.element.get() - input.held) <= input.deadband);
  });
}

bool IdleLedger::wake_disturbed(Time time) {
  bool any = false;
  for (const std::size_t i : candidates_) {
    if (!accounts_[i].rests) continue;
    if (!exchange_.has_discrete_change(i) && !is_disturbed(accounts_[i])) continue;
    any |= accounts_[i].since < time;
    wake_and_tell(i, time);
  }
  return any;
}

void IdleLedger::rest(Time time) {
  for (const std::size_t i : candidates_) {
    if (accounts_[i].rests) continue;
    exchange_.deliver_routed(i, *units_[i]);
    const Time until = accounts_[i].promises->idle_until();
    if (until <= time) continue;
    const Duration max_skip = accounts_[i].max_skip;
    const bool is_bounded = max_skip != Duration::max() && time + max_skip < until;
    const Time end = is_bounded ? time + max_skip : until;
    if (end - options_.least >= time) begin_rest(i, time, until, end);
  }
}

void IdleLedger::begin_rest(std::size_t component, Time time, Time until, Time end) {
  Account& account = accounts_[component];
  account.rests = true;
  account.since = time;
  account.until = until;
  account.end = end;
  exchange_.fetch(component, *units_[component]);
  for (WatchedInput& input : account.inputs) input.held = input.element.get();
  if (account.tangents.empty()) return;
  account.promises->get_derivatives(account.references, account.slopes);
  for (std::size_t k = 0; k < account.tangents.size(); ++k) {
    Tangent& tangent = account.tangents[k];
    tangent.value = tangent.element.get();
    tangent.slope = account.slopes[k];
  }
}

void IdleLedger::settle(Time time) {
  for (const std::size_t i : candidates_) {
    if (accounts_[i].rests) wake_and_tell(i, time);
  }
}

}  // namespace stride::core
