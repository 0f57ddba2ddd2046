// Between stride's time and SystemC's, exactly.
#ifndef STRIDE_SYSTEMC_TIME_H
#define STRIDE_SYSTEMC_TIME_H

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <systemc>

#include <stride/time.h>
#include <stride/time_text.h>

namespace stride::systemc {

/// How many units of the current context's time resolution make one picosecond: 1 by default, 1000
/// if the device has set 1 fs, 0 if it has set a resolution that cannot express a picosecond.
inline std::uint64_t ticks_per_picosecond() {
  return sc_core::sc_get_time_resolution() > sc_core::sc_time(1, sc_core::SC_PS)
             ? 0
             : sc_core::sc_time(1, sc_core::SC_PS).value();
}

/// For a duration that is not negative. Throws std::out_of_range for one beyond SystemC's time,
/// which has 64 bits: at a resolution of 1 ps it ends after 213 days.
inline sc_core::sc_time to_sc_time(Duration duration, std::uint64_t ticks = 1) {
  __extension__ using Wide = unsigned __int128;
  const Wide value = static_cast<Wide>(duration.count()) * ticks;
  if (value <= std::numeric_limits<std::uint64_t>::max()) {
    return sc_core::sc_time::from_value(static_cast<std::uint64_t>(value));
  }
  throw std::out_of_range(
      decimal_seconds(duration) + " s is beyond SystemC's time, which ends at " +
      sc_core::sc_time::from_value(std::numeric_limits<std::uint64_t>::max()).to_string());
}

/// Rounded down to a whole picosecond.
inline Duration to_duration(const sc_core::sc_time& time, std::uint64_t ticks = 1) {
  return Duration(static_cast<Picoseconds>(time.value() / ticks));
}

/// The true time of the device that is running, rounded down to a whole picosecond. It is ahead of
/// sc_time_stamp() by all that has been skipped, so a device stamps and measures with it only.
Time current_time();

}  // namespace stride::systemc

#endif
