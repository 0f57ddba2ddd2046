#include "master/engine/run/events/clocks.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"

namespace stride::core {
namespace {

constexpr Duration kResolution{1};
/// Of shorter intervals a picosecond is more than a millionth.
constexpr Duration kLeastMerged = std::chrono::microseconds(1);

}  // namespace

std::optional<Time> Clocks::Rhythm::instant(std::uint64_t k) const {
  return tick_time(base, shift, interval, k);
}

/// From the rounded one where its fraction has no room.
Clocks::Rhythm Clocks::Rhythm::from(std::uint64_t k) const {
  if (const auto exact = sum(shift, interval, k)) return {base, *exact, interval};
  return {instant(k).value_or(base), {}, interval};
}

std::optional<std::uint64_t> Clocks::Rhythm::number_at(Time time) const {
  constexpr double kRoundingPerSecond = 1e-15;
  const double since = to_seconds(time - base) - shift.seconds();
  const double size = interval.seconds();
  const double number = std::round(since / size);
  const double tolerance = 2e-12 + std::abs(since) * kRoundingPerSecond;
  if (!(number >= 0) || std::abs(number * size - since) > tolerance) return std::nullopt;
  const auto k = static_cast<std::uint64_t>(number);
  const std::optional<Time> nearest = instant(k);
  const bool is_there = nearest && *nearest - time <= kResolution && time - *nearest <= kResolution;
  return is_there ? std::optional(k) : std::nullopt;
}

Clocks::Clocks(const System& system, std::span<const std::unique_ptr<Unit>> units,
               std::vector<Grid> steps)
    : system_(system),
      units_(units),
      steps_(std::move(steps)),
      intervals_(capabilities<ClockIntervals>(units)) {
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
  if (clock.attributes->is_periodic() && clock.attributes->interval) {
    clock.rhythm = {start_time, clock.attributes->shift, *clock.attributes->interval};
  } else {
    persist_rhythm(state, clock, start_time, now);
  }
  state.value(clock.count);
  if (clock.is_constant()) {
    clock.next = clock.rhythm.instant(clock.count);
  } else {
    state.value(clock.next);
  }
  if (clock.next && *clock.next <= now) state.fail("a tick has not been made");
}

void Clocks::persist_rhythm(StateArchive& state, Schedule& clock, Time start_time, Time now) {
  auto& [base, shift, interval] = clock.rhythm;
  state.value(base);
  shift.persist(state);
  interval.persist(state);
  const bool is_too_short = clock.attributes->is_periodic() && interval.is_below_picosecond();
  if (base < start_time || base > now || is_too_short) {
    state.fail("a clock has another beginning, or interval, than is possible");
  }
}

void Clocks::resume(const Clocks& other) {
  clocked_ = other.clocked_;
  is_stale_ = true;
  next_.reset();
  due_.clear();
  find_due(Time::min());
}

void Clocks::start(Schedule& clock, Time start_time) {
  Rhythm& rhythm = clock.rhythm;
  rhythm = {start_time, {}, {}};
  if (clock.attributes->interval) {
    rhythm.interval = *clock.attributes->interval;
    rhythm.shift = clock.attributes->shift;
  } else {
    const ClockInterval reported = query_interval(clock, start_time);
    if (reported.state == ClockInterval::State::NotYetKnown) return;
    rhythm.interval = reported.interval;
    const bool periodic = clock.attributes->is_periodic();
    rhythm.shift = periodic
                       ? intervals_[clock.id.component]->clock_shift(system_.variable(clock.id))
                       : reported.interval;
  }
  check_interval(clock, start_time);
  choose_next(clock, start_time);
}

/// The tick of number `count`, which is later than `now` or there.
void Clocks::choose_next(Schedule& clock, Time now) const {
  clock.next = clock.rhythm.instant(clock.count);
  if (!clock.next || clock.is_constant()) return;
  if (*clock.next - now >= kLeastMerged) clock.next = merged(clock, *clock.next);
}

/// The time of what is within a picosecond of this tick, or that of the tick itself.
Time Clocks::merged(const Schedule& clock, Time tick) const {
  if (const auto there = constant_rhythm_at(tick)) return *there->instant(0);
  for (const ComponentClocks& own : clocked_) {
    for (const Schedule& other : own.clocks) {
      if (&other == &clock || !other.next) continue;
      if (*other.next - tick <= kResolution && tick - *other.next <= kResolution)
        return *other.next;
    }
  }
  return tick;
}

/// What this instant was before it was rounded, for a clock that gets another interval at it.
Clocks::Rhythm Clocks::exact_instant(const Schedule& clock, Time time, bool ticked) const {
  const auto there = constant_rhythm_at(time);
  if (there && *there->instant(0) == time) return *there;
  return ticked ? clock.rhythm.from(clock.count - 1) : Rhythm{time, {}, {}};
}

/// From the point or tick on that is within a picosecond of this time.
std::optional<Clocks::Rhythm> Clocks::constant_rhythm_at(Time time) const {
  const Interval least(kLeastMerged);
  const auto beginning_at = [&](const Rhythm& rhythm) -> std::optional<Rhythm> {
    if (rhythm.interval < least) return std::nullopt;
    const auto number = rhythm.number_at(time);
    return number ? std::optional(rhythm.from(*number)) : std::nullopt;
  };
  for (const Grid& grid : steps_) {
    if (const auto there = beginning_at({grid.start(), {}, grid.step()})) return there;
  }
  for (const ComponentClocks& own : clocked_) {
    for (const Schedule& other : own.clocks) {
      if (!other.is_constant()) continue;
      if (const auto there = beginning_at(other.rhythm)) return there;
    }
  }
  return std::nullopt;
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
  if (!clock.attributes->is_periodic() || !clock.rhythm.interval.is_below_picosecond()) return;
  fail(clock, time,
       fmt::format("the clock's interval is {} s, and times are counted in picoseconds",
                   clock.rhythm.interval.seconds()));
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
      ++clock.count;
      clock.next.reset();
      if (clock.attributes->is_periodic()) choose_next(clock, time);
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
  Rhythm instant = exact_instant(clock, time, ticked);
  // the tick may have been made with another one, a picosecond beside it
  const bool is_short = reported.interval < Interval(kLeastMerged);
  if (is_short && instant.instant(0) != time) instant = {time, {}, {}};
  clock.rhythm = {instant.base, instant.shift, reported.interval};
  check_interval(clock, time);
  clock.count = 1;
  choose_next(clock, time);
  is_stale_ = true;
}

}  // namespace stride::core
