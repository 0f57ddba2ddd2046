// Simulated time: a 64-bit count of picoseconds since the start of the simulation (106 days).
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

using Duration = std::chrono::duration<std::int64_t, std::pico>;
using Time = std::chrono::time_point<SimulationClock, Duration>;

/// The largest time that can be represented, about 106 days.
inline constexpr double kMaxSeconds = 9.2e6;

/// The nearest double [s].
constexpr double to_seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e12;
}
constexpr double to_seconds(Time time) { return to_seconds(time.time_since_epoch()); }

namespace detail {

/// std::llround() of what an std::int64_t can hold, without a call. It neither adds nor subtracts
/// doubles, so that no compiler can fuse it with the product that it is given.
inline std::int64_t nearest(double value) {
  constexpr double kAllAreWhole = 4503599627370496;  // 2^52
  if (std::abs(value) >= kAllAreWhole) return static_cast<std::int64_t>(value);
  const auto halves = static_cast<std::int64_t>(2 * value);
  return (halves + (halves < 0 ? -1 : 1)) / 2;
}

}  // namespace detail

/// The nearest picosecond. Throws std::out_of_range for what is not finite or beyond kMaxSeconds.
inline Duration duration_from_seconds(double seconds) {
  if (!(std::abs(seconds) <= kMaxSeconds)) {
    throw std::out_of_range("a time must be a finite number of seconds within 9.2e6");
  }
  return Duration(detail::nearest(seconds * 1e12));
}
inline Time time_from_seconds(double seconds) { return Time(duration_from_seconds(seconds)); }

/// time + duration, which is not negative, or the last instant that there is if that is earlier.
constexpr Time later(Time time, Duration duration) {
  return time > Time::max() - duration ? Time::max() : time + duration;
}

}  // namespace stride

#endif
