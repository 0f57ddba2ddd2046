// The unit of a trace's time stamps.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_TIMESCALE_H
#define STRIDE_MASTER_OBSERVE_TRACE_TIMESCALE_H

#include <cstdint>
#include <string>
#include <string_view>

#include <stride/time.h>

namespace stride::trace {

/// One, ten or a hundred times a unit from fs to s: a tick is 10^exponent seconds.
struct Timescale {
  int exponent = -12;

  /// "1 ps", "10ns". Throws std::invalid_argument that contains what was expected.
  static Timescale parse(std::string_view text);
  /// "10 ns"
  std::string text() const;
  /// Exact decimal seconds without trailing zeros.
  std::string seconds(std::int64_t ticks) const;
  /// The whole ticks in a duration that is not negative; the largest number where there are more.
  std::int64_t ticks_in(Duration duration) const;

  friend bool operator==(Timescale, Timescale) = default;
};

}  // namespace stride::trace

#endif
