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
    Duration ahead = lead();
    while (kernel_.now() < to) {
      const Time next = kernel_.now() + std::min(ahead, to - kernel_.now());
      if (kernel_.approach(next, may_stop_early) < next) return kernel_.now();
      if (!kernel_.at_rest()) {
        ahead = kTick;  // what is due here has not happened yet
      } else {
        ahead = skip(to, max_skip) ? lead() : until_next_check();
      }
    }
    return kernel_.advance(to);
  });
}

Duration IdleSkipper::lead() const { return std::max(rules_.clock_period(), kTick); }

Duration IdleSkipper::until_next_check() {
  const std::optional<Time> next = kernel_.next_event();
  return next ? std::max(kCheckInterval, *next - kernel_.now()) : Duration::max();
}

bool IdleSkipper::skip(Time to, Duration max_skip) {
  if (!rules_.idle()) return false;
  const Duration skipped = room(to, max_skip);
  if (skipped < kWorthwhile) return false;
  if (is_obstructed()) return false;
  kernel_.skip(skipped);
  rules_.on_skip(skipped);
  ++statistics_.skips;
  statistics_.skipped += skipped;
  statistics_.longest = std::max(statistics_.longest, skipped);
  return true;
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

std::string obstacle_text(Time obstacle) {
  std::ostringstream text;
  text << "the device declared itself idle, but SystemC had something to notify at "
       << to_seconds(obstacle)
       << " s: such time is not skipped; use a Timer in the place of wait(time) or notify(delay), "
          "let idle() return false meanwhile, or declare the period of the clock that continues";
  return text.str();
}

}  // namespace stride::systemc
