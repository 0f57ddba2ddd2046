#include "master/engine/run/idle/idle_scheduler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"

namespace stride::core {

IdleScheduler::IdleScheduler(RunContext& context)
    : system_(context.system),
      units_(context.units),
      exchange_(context.exchange),
      statistics_(context.statistics.units),
      activities_(context.activities),
      options_(context.options.idle),
      states_(units_.size()) {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (const auto longest = options_.longest_suspension(system_, i)) {
      add_candidate(i, *longest);
    } else {
      are_others_own_ &= system_.components()[i].keeps_own_step();
    }
  }
  find_sources();
}

void IdleScheduler::add_candidate(std::size_t component, Duration max_skip) {
  candidates_.push_back(component);
  IdleState& state = states_[component];
  state.is_candidate = true;
  state.promises = &units_[component]->require_capability<IdlePromises>();
  state.max_skip = max_skip;
  for (const auto& [id, element] : exchange_.continuous_inputs(component)) {
    state.inputs.push_back({element, options_.deadband(system_, id)});
  }
  std::size_t elements = 0;
  for (const auto& [id, element] : exchange_.outputs_with_tolerance(component)) {
    if (elements == state.tangents.size()) {
      state.references.push_back(system_.variable(id).reference);
      elements += system_.variable(id).size;
    }
    state.tangents.push_back({id, element});
  }
  state.slopes.resize(elements);
}

/// Where all units are suspended, nothing but tangents moves their inputs.
void IdleScheduler::find_sources() {
  std::map<ValueSlice, const Tangent*> tangents;
  for (const std::size_t i : candidates_) {
    for (const Tangent& tangent : states_[i].tangents) tangents.emplace(tangent.element, &tangent);
  }
  std::map<ValueSlice, const ContinuousLink*> links;  // by target
  const std::vector<ContinuousLink> all = exchange_.continuous_links();
  for (const ContinuousLink& link : all) links.emplace(link.target, &link);
  for (const std::size_t i : candidates_) {
    for (WatchedInput& input : states_[i].inputs) {
      const auto link = links.find(input.element);
      if (link == links.end()) continue;
      const auto tangent = tangents.find(link->second->source);
      if (tangent == tangents.end()) continue;
      input.source = tangent->second;
      input.factor = link->second->conversion.factor;
    }
  }
}

void IdleScheduler::enable() {
  for (const std::size_t i : candidates_) {
    states_[i].promises->enable_idle_skipping(states_[i].max_skip);
  }
  for (const IdleSetting& setting : options_.tolerances) {
    if (!may_suspend(setting.id.component)) continue;
    states_[setting.id.component].promises->set_idle_tolerances(
        {&system_.variable(setting.id).reference, 1}, {&setting.value, 1});
  }
}

std::optional<Time> IdleScheduler::all_suspended_until(Time time) const {
  if (!are_others_own_) return std::nullopt;
  Time earliest = Time::max();
  for (const std::size_t i : candidates_) {
    if (!states_[i].is_suspended) return std::nullopt;
    earliest = std::min(earliest, states_[i].end);
  }
  for (const std::size_t i : candidates_) {
    for (const WatchedInput& input : states_[i].inputs) {
      if (input.source != nullptr) earliest = std::min(earliest, leaves_deadband(input, time));
    }
  }
  return earliest;
}

/// The last instant at which the input is within its deadband, if its source goes on as it does.
Time IdleScheduler::leaves_deadband(const WatchedInput& input, Time time) {
  const double rate = input.factor * input.source->slope;
  if (rate == 0) return Time::max();
  const double deviation = real(input.element) - input.held;
  const double room = input.deadband - (rate > 0 ? deviation : -deviation);
  const double seconds = room / std::abs(rate);
  if (!(seconds > 0)) return time;
  return seconds <= kMaxSeconds ? time + duration_from_seconds(seconds) : Time::max();
}

Duration IdleScheduler::suspended_time(Time time) const {
  Duration sum{};
  for (const std::size_t i : candidates_) {
    sum += statistics_[i].suspended_time;
    if (states_[i].is_suspended) sum += time - states_[i].since;
  }
  return sum;
}

bool IdleScheduler::catch_up(std::size_t component, Time time) {
  IdleState& state = states_[component];
  state.is_suspended = false;
  const Duration lag = time - state.since;
  if (lag == Duration{}) return false;
  state.unreported_end = time;
  const StepResult result = units_[component]->step({state.since, time});
  check_promise(component, time, result);
  exchange_.read_outputs(component, *units_[component]);
  UnitStatistics& statistics = statistics_[component];
  ++statistics.suspensions;
  statistics.suspended_time += lag;
  statistics.longest_suspension = std::max(statistics.longest_suspension, lag);
  return result.event_handling_needed;
}

void IdleScheduler::report_suspension(std::size_t component) {
  IdleState& state = states_[component];
  const std::optional<Time> ended = std::exchange(state.unreported_end, std::nullopt);
  if (ended) activities_.report({component, Activity::Kind::Idle, state.since, *ended});
}

bool IdleScheduler::catch_up_and_report(std::size_t component, Time time) {
  const bool has_event = catch_up(component, time);
  report_suspension(component);
  return has_event;
}

void IdleScheduler::report_unfinished(Time time) {
  for (const std::size_t i : candidates_) {
    IdleState& state = states_[i];
    if (std::exchange(state.is_suspended, false) && state.since < time) state.unreported_end = time;
    report_suspension(i);
  }
}

void IdleScheduler::check_promise(std::size_t component, Time time,
                                  const StepResult& result) const {
  const IdleState& state = states_[component];
  const bool is_early_event = result.event_handling_needed && time < state.until;
  if (!result.rejected && result.reached == time && !is_early_event) return;
  const std::string violation = result.rejected ? "rejects the step to there"
                                : result.reached != time
                                    ? fmt::format("returns early at {} s", to_text(result.reached))
                                    : "has an event";
  fail_run(
      {{}, system_.components()[component].name, {}, time},
      fmt::format("the unit promised at {} s to be idle until {}, but {}", to_text(state.since),
                  state.until == Time::max() ? "an input changes" : to_text(state.until) + " s",
                  violation),
      "the unit does not keep its promise; until it is corrected, switch idle skipping off for it");
}

std::span<const std::size_t> IdleScheduler::advance_to(Time time) {
  events_.clear();
  for (const std::size_t i : candidates_) {
    IdleState& state = states_[i];
    if (!state.is_suspended) continue;
    if (state.end <= time) {
      if (catch_up_and_report(i, time)) events_.push_back(i);
      continue;
    }
    const double elapsed = to_seconds(time - state.since);
    for (const Tangent& tangent : state.tangents) tangent.follow(elapsed);
  }
  return events_;
}

bool IdleScheduler::is_disturbed(const IdleState& state) const {
  return std::any_of(state.inputs.begin(), state.inputs.end(), [](const WatchedInput& input) {
    return !(std::abs(real(input.element) - input.held) <= input.deadband);
  });
}

bool IdleScheduler::catch_up_disturbed(Time time) {
  bool any = false;
  for (const std::size_t i : candidates_) {
    if (!states_[i].is_suspended) continue;
    if (!exchange_.has_discrete_change(i) && !is_disturbed(states_[i])) continue;
    any |= states_[i].since < time;
    catch_up_and_report(i, time);
  }
  return any;
}

void IdleScheduler::suspend_idle(Time time) {
  for (const std::size_t i : candidates_) {
    if (states_[i].is_suspended) continue;
    exchange_.write_routed_inputs(i, *units_[i]);
    const Time until = states_[i].promises->idle_until();
    if (until <= time) continue;
    const Duration max_skip = states_[i].max_skip;
    const bool is_bounded = max_skip != Duration::max() && time + max_skip < until;
    const Time end = is_bounded ? time + max_skip : until;
    if (end - options_.least >= time) suspend(i, time, until, end);
  }
}

void IdleScheduler::suspend(std::size_t component, Time time, Time until, Time end) {
  IdleState& state = states_[component];
  state.is_suspended = true;
  state.since = time;
  state.until = until;
  state.end = end;
  exchange_.read_outputs(component, *units_[component]);
  for (WatchedInput& input : state.inputs) input.held = real(input.element);
  if (state.tangents.empty()) return;
  state.promises->get_derivatives(state.references, state.slopes);
  for (std::size_t k = 0; k < state.tangents.size(); ++k) state.tangents[k].begin(state.slopes[k]);
}

void IdleScheduler::persist(StateArchive& state, Time start, Time now) {
  state.mark("idle units");
  state.fixed(candidates_, [&](std::size_t i) { persist(state, i, start, now); });
}

void IdleScheduler::persist(StateArchive& state, std::size_t component, Time start, Time now) {
  IdleState& unit = states_[component];
  state.value(unit.is_suspended);
  if (!unit.is_suspended) return;
  state.value(unit.since);
  state.value(unit.until);
  state.value(unit.end);
  if (unit.since < start || unit.since > now || unit.end < now || unit.end > unit.until) {
    state.fail("a unit is suspended at another time");
  }
  state.fixed(unit.inputs, [&](WatchedInput& input) { state.value(input.held); });
  persist_tangents(state, component);
}

/// As the Exchange does with the outputs that they belong to: what is not read any more is dropped.
void IdleScheduler::persist_tangents(StateArchive& state, std::size_t component) {
  const auto& variables = system_.components()[component].description->variables;
  std::map<std::uint64_t, std::vector<Tangent*>> own;
  for (Tangent& tangent : states_[component].tangents) own[tangent.id.variable].push_back(&tangent);
  std::vector<std::uint64_t> keys;
  for (const auto& [key, tangents] : own) keys.push_back(key);
  state.keys(keys, variables.size());
  for (const std::uint64_t key : keys) {
    if (const auto found = own.find(key); found != own.end()) {
      for (Tangent* const tangent : found->second) persist(state, *tangent);
    } else {
      drop_tangents(state, variables[key]);
    }
  }
  for (const auto& [key, tangents] : own) {
    const VariableId id{component, key};
    const bool is_new = std::ranges::binary_search(exchange_.new_outputs(), id);
    const bool is_there = std::ranges::binary_search(keys, key);
    if (is_there == is_new) state.fail("an output has a tangent without a value, or none");
  }
}

void IdleScheduler::persist(StateArchive& state, Tangent& tangent) {
  state.value(tangent.value);
  state.value(tangent.slope);
}

void IdleScheduler::drop_tangents(StateArchive& state, const Variable& output) {
  if (!output.tolerance) state.fail("an output without a tolerance has a tangent");
  Tangent dropped;
  for (std::size_t k = 0; k < output.size; ++k) persist(state, dropped);
}

void IdleScheduler::take_new_tangents(Time now) {
  if (exchange_.new_outputs().empty()) return;
  for (const std::size_t i : candidates_) {
    if (states_[i].is_suspended) take_new_tangents(i, now);
  }
}

/// The unit is where it was suspended, and so are the values that have been read of it.
void IdleScheduler::take_new_tangents(std::size_t component, Time now) {
  IdleState& state = states_[component];
  std::vector<Tangent*> tangents;
  std::vector<ValueReference> references;
  for (Tangent& tangent : state.tangents) {
    if (!std::ranges::binary_search(exchange_.new_outputs(), tangent.id)) continue;
    const bool is_first = tangents.empty() || tangents.back()->id != tangent.id;
    if (is_first) references.push_back(system_.variable(tangent.id).reference);
    tangents.push_back(&tangent);
  }
  if (tangents.empty()) return;
  std::vector<double> slopes(tangents.size());
  state.promises->get_derivatives(references, slopes);
  for (std::size_t k = 0; k < tangents.size(); ++k) {
    tangents[k]->begin(slopes[k]);
    if (now != state.since) tangents[k]->follow(to_seconds(now - state.since));
  }
}

void IdleScheduler::catch_up_all(Time time) {
  for (const std::size_t i : candidates_) {
    if (states_[i].is_suspended) catch_up_and_report(i, time);
  }
}

}  // namespace stride::core
