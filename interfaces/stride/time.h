// Simulated time: a count of picoseconds, wide enough for any simulation.
//
// Time is integer everywhere. Doubles exist only at the FMI edge, and each is converted from the
// exact count, so nothing drifts.
#ifndef STRIDE_TIME_H
#define STRIDE_TIME_H

#include <chrono>
#include <cmath>
#include <cstdint>
#include <ratio>
#include <stdexcept>

namespace stride {

struct SimulationClock {};

/// 64 bits would end after 106 days, and a device may sleep for years.
__extension__ using Picoseconds = __int128;
using Duration = std::chrono::duration<Picoseconds, std::pico>;
using Time = std::chrono::time_point<SimulationClock, Duration>;

/// The largest time of a simulation: 32 million years.
inline constexpr double kMaxSeconds = 1e15;

namespace detail {

inline constexpr std::int64_t kPicosecondsPerSecond = 1'000'000'000'000;

/// Below this many seconds, about 106 days, 64 bits hold the count.
inline constexpr double kNarrowSeconds = 9.2e6;

constexpr bool is_narrow(Picoseconds count) { return static_cast<std::int64_t>(count) == count; }

/// std::llround() of what an std::int64_t can hold, without a call. It neither adds nor subtracts
/// doubles, so that no compiler can fuse it with the product that it is given.
inline std::int64_t nearest(double value) {
  constexpr double kAllAreWhole = 4503599627370496;  // 2^52
  if (std::abs(value) >= kAllAreWhole) return static_cast<std::int64_t>(value);
  const auto halves = static_cast<std::int64_t>(2 * value);
  return (halves + (halves < 0 ? -1 : 1)) / 2;
}

}  // namespace detail

/// Whole seconds and the picoseconds beside them, both of the same sign.
struct SplitDuration {
  std::int64_t seconds, picoseconds;
};
/// Of a duration within kMaxSeconds.
constexpr SplitDuration split(Duration duration) {
  const Picoseconds count = duration.count();
  if (detail::is_narrow(count)) {
    const auto narrow = static_cast<std::int64_t>(count);
    return {narrow / detail::kPicosecondsPerSecond, narrow % detail::kPicosecondsPerSecond};
  }
  return {static_cast<std::int64_t>(count / detail::kPicosecondsPerSecond),
          static_cast<std::int64_t>(count % detail::kPicosecondsPerSecond)};
}

/// The nearest double [s].
constexpr double to_seconds(Duration duration) {
  if (detail::is_narrow(duration.count())) {
    return static_cast<double>(static_cast<std::int64_t>(duration.count())) / 1e12;
  }
  const Picoseconds seconds = duration.count() / detail::kPicosecondsPerSecond;
  const Picoseconds rest = duration.count() % detail::kPicosecondsPerSecond;
  return static_cast<double>(seconds) + static_cast<double>(rest) / 1e12;
}
constexpr double to_seconds(Time time) { return to_seconds(time.time_since_epoch()); }

/// The nearest picosecond. Throws std::out_of_range for what is not finite or beyond kMaxSeconds.
inline Duration duration_from_seconds(double seconds) {
  if (!(std::abs(seconds) <= kMaxSeconds)) {
    throw std::out_of_range("a time must be a finite number of seconds within 1e15");
  }
  if (std::abs(seconds) <= detail::kNarrowSeconds) return Duration(detail::nearest(seconds * 1e12));
  const auto whole = static_cast<std::int64_t>(seconds);
  const double rest = seconds - static_cast<double>(whole);
  return Duration(Picoseconds{whole} * detail::kPicosecondsPerSecond +
                  detail::nearest(rest * 1e12));
}
inline Time time_from_seconds(double seconds) { return Time(duration_from_seconds(seconds)); }

/// The largest one of which both are multiples; they are not negative.
constexpr Duration common_divisor(Duration a, Duration b) {
  while (b != Duration()) {
    const Duration rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

/// time + duration, which is not negative, or the last instant that there is if that is earlier.
constexpr Time later(Time time, Duration duration) {
  return time > Time::max() - duration ? Time::max() : time + duration;
}

}  // namespace stride

#endif
