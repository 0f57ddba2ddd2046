#include <algorithm>
#include <sstream>

#include <stride/systemc/idle.h>

namespace stride::systemc {
namespace {

constexpr Duration kTick{1};
constexpr Duration kCheckInterval{10'000'000};
constexpr Duration kWorthwhile{1'000'000};

}  // namespace

Time IdleSkipper::advance(Time to, bool may_stop_early, Duration max_skip) {
  return kernel_.within([&] {
    has_settled_ = false;
    note_state();
    Duration ahead = lead();
    while (kernel_.now() < to) {
      const Time next = kernel_.now() + std::min(ahead, to - kernel_.now());
      if (kernel_.approach(next, may_stop_early) < next) {
        has_settled_ = false;
        return kernel_.now();
      }
      if (next == to) break;
      ahead =
          kernel_.at_rest() ? look(to, max_skip) : kTick;  // what is due here has not happened yet
    }
    kernel_.advance(to);
    if (rules_.idle() && is_period_over()) compare_states();
    return kernel_.now();
  });
}

Duration IdleSkipper::lead() const { return std::max(rules_.clock_period(), kTick); }

Duration IdleSkipper::until_next_check() {
  const std::optional<Time> next = kernel_.next_event();
  return next ? std::max(kCheckInterval, *next - kernel_.now()) : Duration::max();
}

// Skips if it can; returns how far ahead the next look is. The states are compared also where there
// is nothing to skip: a promise needs it, too.
Duration IdleSkipper::look(Time to, Duration max_skip) {
  if (!rules_.idle()) {
    has_settled_ = false;
    return until_next_check();
  }
  const Comparison comparison = compare_states();
  if (comparison == Comparison::Changed && is_restless()) return until_next_check();
  if (comparison != Comparison::Same) return lead();
  const Duration skipped = room(to, max_skip);
  if (skipped < kWorthwhile || is_obstructed()) return until_next_check();
  skip(skipped);
  return lead();
}

void IdleSkipper::skip(Duration skipped) {
  kernel_.skip(skipped);
  rules_.on_skip(skipped);
  ++statistics_.skips;
  statistics_.skipped += skipped;
  statistics_.longest = std::max(statistics_.longest, skipped);
}

bool IdleSkipper::note_state() {
  watched_at_ = simulated();
  return watch_ && watch_->has_changed();
}

// The phase of the clock must be the same, or a picosecond later: what is due at one look happens
// before the next. Over several periods a counter may have come round.
bool IdleSkipper::is_period_over() const {
  const Duration elapsed = simulated() - watched_at_;
  return elapsed >= lead() && elapsed <= lead() + kTick;
}

IdleSkipper::Comparison IdleSkipper::compare_states() {
  if (!watch_) return Comparison::Same;
  const bool is_comparable = is_period_over();
  const bool has_changed = note_state();
  has_settled_ = is_comparable && !has_changed;
  if (!is_comparable) return Comparison::None;
  changes_ = has_changed ? std::min(changes_ + 1, kMostChanges) : 0;
  if (is_restless() && !unrest_) unrest_ = Unrest{kernel_.now(), watch_->place()};
  return has_changed ? Comparison::Changed : Comparison::Same;
}

// It may be nearer than an edge of the clock by the next look, so the last one of them is kept.
bool IdleSkipper::is_obstructed() {
  if (obstructed_until_ >= kernel_.now()) return true;
  const Duration period = rules_.clock_period();
  if (period == Duration{}) {
    const std::optional<Time> next = kernel_.next_notification();
    if (next) obstacle_ = next;
    return next.has_value();
  }
  const auto pending = kernel_.unclocked_notifications(period);
  if (!pending) return false;
  obstacle_ = pending->first;
  obstructed_until_ = pending->last;
  return true;
}

Duration IdleSkipper::room(Time to, Duration max_skip) const {
  const Time end = std::min(to, kernel_.next_timer().value_or(to));
  const Duration room = std::min({end - kernel_.now() - kTick, max_skip, rules_.longest_skip()});
  const Duration period = lead();
  return room / period * period;
}

std::string to_text(const IdleSkipper::Statistics& statistics) {
  std::ostringstream text;
  text << "skipped " << to_seconds(statistics.skipped) << " s of its idle time, in "
       << statistics.skips << " skips, the longest of " << to_seconds(statistics.longest) << " s";
  return text.str();
}

std::string unrest_text(const IdleSkipper::Unrest& unrest) {
  std::ostringstream text;
  text << "the device declared itself idle, but each period of its clock changed it, at "
       << to_seconds(unrest.when) << " s in or behind " << unrest.place
       << "; such time is simulated: the first argument of idle_when() should be false meanwhile, "
          "or the second say what the module counts, by repeats_every() or a function";
  return text.str();
}

std::string obstacle_text(Time obstacle) {
  std::ostringstream text;
  text << "the device declared itself idle, but SystemC had something to notify at "
       << to_seconds(obstacle)
       << " s: such time is not skipped; use a Timer in the place of wait(time) or notify(delay), "
          "let idle() return false meanwhile, or declare the period of the clock that continues";
  return text.str();
}

}  // namespace stride::systemc
