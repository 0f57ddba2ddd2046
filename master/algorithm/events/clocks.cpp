#include "master/algorithm/events/clocks.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/util/state_archive.h"

namespace stride::core {

Clocks::Clocks(const System& system, std::span<const std::unique_ptr<Unit>> units)
    : system_(system), units_(units), intervals_(capabilities<ClockIntervals>(units)) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    ComponentClocks own{i, {}, {}};
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const Variable& variable = variables[v];
      if (!variable.is_time_based_clock()) continue;
      own.clocks.push_back({{i, v}, variable.reference, &*variable.clock});
    }
    index_of_.push_back(clocked_.size());
    if (own.clocks.empty()) {
      index_of_.back() = system.components().size();
      continue;
    }
    most = std::max(most, own.clocks.size());
    own.ticking.reserve(own.clocks.size());
    clocked_.push_back(std::move(own));
  }
  due_.reserve(clocked_.size());
  for (std::size_t count = 1; count <= most; ++count) {
    std::ranges::fill(ticks_.emplace_back(ValueType::Clock, count).numbers<bool>(), true);
  }
}

Clocks::ComponentClocks* Clocks::clocks_of(std::size_t component) {
  const std::size_t index = index_of_[component];
  return index < clocked_.size() ? &clocked_[index] : nullptr;
}

void Clocks::begin(Time start_time) {
  for (ComponentClocks& own : clocked_) {
    for (Schedule& clock : own.clocks) start(clock, start_time);
  }
  is_stale_ = true;
  due(start_time);
}

void Clocks::persist(StateArchive& state, Time start_time, Time now) {
  state.mark("clocks");
  for (ComponentClocks& own : clocked_) {
    for (Schedule& clock : own.clocks) persist(state, clock, start_time, now);
  }
  if (!state.is_reading()) return;
  is_stale_ = true;
  find_due(now);
}

void Clocks::persist(StateArchive& state, Schedule& clock, Time start_time, Time now) {
  if (clock.attributes->is_periodic()) {
    persist_period(state, clock, start_time, now);
  } else {
    state.value(clock.next);
  }
  if (clock.next && *clock.next <= now) state.fail("a tick has not been made");
}

void Clocks::persist_period(StateArchive& state, Schedule& clock, Time start_time, Time now) {
  if (clock.attributes->interval) {
    clock.base = start_time;
    clock.shift = clock.attributes->shift;
    clock.interval = *clock.attributes->interval;
  } else {
    state.value(clock.base);
    clock.shift.persist(state);
    clock.interval.persist(state);
    if (clock.base < start_time || clock.base > now || clock.interval.is_below_picosecond()) {
      state.fail("a clock has another beginning, or interval, than is possible");
    }
  }
  state.value(clock.count);
  clock.next = tick_time(clock.base, clock.shift, clock.interval, clock.count);
}

void Clocks::resume(const Clocks& other) {
  clocked_ = other.clocked_;
  is_stale_ = true;
  next_.reset();
  due_.clear();
  find_due(Time::min());
}

void Clocks::start(Schedule& clock, Time start_time) {
  clock.base = start_time;
  if (clock.attributes->interval) {
    clock.interval = *clock.attributes->interval;
    clock.shift = clock.attributes->shift;
  } else {
    const ClockInterval reported = query_interval(clock, start_time);
    if (reported.state == ClockInterval::State::NotYetKnown) return;
    clock.interval = reported.interval;
    const bool periodic = clock.attributes->is_periodic();
    clock.shift = periodic ? intervals_[clock.id.component]->clock_shift(system_.variable(clock.id))
                           : reported.interval;
  }
  check_interval(clock, start_time);
  clock.next = tick_time(start_time, clock.shift, {}, 0);
}

ClockInterval Clocks::query_interval(const Schedule& clock, Time time) {
  ClockIntervals* const intervals = intervals_[clock.id.component];
  const ClockInterval reported = intervals == nullptr
                                     ? ClockInterval{}
                                     : intervals->clock_interval(system_.variable(clock.id));
  const bool may_be_unknown = clock.attributes->variability == IntervalVariability::Countdown;
  if (reported.state == ClockInterval::State::NotYetKnown && !may_be_unknown) {
    fail(clock, time, "the unit does not know the clock's interval yet");
  }
  return reported;
}

void Clocks::check_interval(const Schedule& clock, Time time) const {
  if (!clock.attributes->is_periodic() || !clock.interval.is_below_picosecond()) return;
  fail(clock, time,
       fmt::format("the clock's interval is {} s, and times are counted in picoseconds",
                   clock.interval.seconds()));
}

void Clocks::fail(const Schedule& clock, Time time, const std::string& message) const {
  fail_run(
      {{}, system_.components()[clock.id.component].name, system_.variable(clock.id).name, time},
      message,
      fmt::format("the clock is a {} one; look at the parameters on which its interval depends",
                  name(clock.attributes->variability)));
}

std::span<const std::size_t> Clocks::find_due(Time time) {
  if (is_stale_) {
    next_.reset();
    for (const ComponentClocks& own : clocked_) {
      for (const Schedule& clock : own.clocks) {
        if (clock.next && (!next_ || *clock.next < *next_)) next_ = clock.next;
      }
    }
    is_stale_ = false;
  }
  due_.clear();
  if (!next_ || *next_ > time) [[likely]]
    return {};
  for (const ComponentClocks& own : clocked_) {
    const bool ticks = std::any_of(own.clocks.begin(), own.clocks.end(), [&](const auto& clock) {
      return clock.next && *clock.next <= time;
    });
    if (ticks) due_.push_back(own.component);
  }
  return due_;
}

std::span<const std::size_t> Clocks::tick(Time time) {
  for (const std::size_t component : due_) {
    ComponentClocks& ticking = *clocks_of(component);
    for (Schedule& clock : ticking.clocks) {
      if (!clock.next || *clock.next > time) continue;
      ticking.ticking.push_back(clock.reference);
      clock.next = clock.attributes->is_periodic()
                       ? tick_time(clock.base, clock.shift, clock.interval, ++clock.count)
                       : std::nullopt;
    }
    units_[component]->set(ticking.ticking, ticks_[ticking.ticking.size() - 1]);
    is_stale_ = true;
  }
  return due_;
}

std::span<const ValueReference> Clocks::ticking(std::size_t component) const {
  const std::size_t index = index_of_[component];
  if (index >= clocked_.size()) return {};
  return clocked_[index].ticking;
}

void Clocks::update(std::size_t component, Time time) {
  ComponentClocks* const updated = clocks_of(component);
  if (updated == nullptr) return;
  for (Schedule& clock : updated->clocks) {
    const auto& ticking = updated->ticking;
    update(clock, time,
           std::find(ticking.begin(), ticking.end(), clock.reference) != ticking.end());
  }
  updated->ticking.clear();
}

/// The intervals that are read are those of table "Overview of Clock types" of FMI 3.0, 2.2.8; the
/// qualifiers are those of "Allowed qualifiers for time-based Clocks".
void Clocks::update(Schedule& clock, Time time, bool ticked) {
  const IntervalVariability variability = clock.attributes->variability;
  const bool is_tunable =
      variability == IntervalVariability::Tunable && !clock.attributes->interval;
  const bool is_next = variability == IntervalVariability::Changing && ticked;
  if (!is_tunable && !is_next && variability != IntervalVariability::Countdown) return;
  const ClockInterval reported = query_interval(clock, time);
  if (reported.state != ClockInterval::State::Changed && !is_next) return;
  clock.interval = reported.interval;
  check_interval(clock, time);
  clock.base = time;
  clock.shift = {};
  clock.count = 1;
  clock.next = tick_time(time, {}, reported.interval, 1);
  is_stale_ = true;
}

}  // namespace stride::core
