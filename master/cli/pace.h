#ifndef STRIDE_MASTER_CLI_PACE_H
#define STRIDE_MASTER_CLI_PACE_H

#include <array>
#include <chrono>
#include <cstddef>

#include <stride/time.h>

namespace stride::cli {

/// How fast a run is now, which is not how fast it has been: units rest at one time and work at
/// another. Looks back over the last seconds of the wall clock.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  Pace(Clock::time_point now, Time time) : last_{now, time} { notes_.fill(last_); }

  /// In the order of both clocks.
  void note(Clock::time_point now, Time time);
  /// Simulated seconds in a second of the wall clock; 0 before there is anything to compare.
  double speed() const;

 private:
  static constexpr std::chrono::milliseconds kInterval{250};
  static constexpr std::size_t kNotes = 20;

  struct Note {
    Clock::time_point wall;
    Time simulated;
  };
  std::array<Note, kNotes> notes_;  ///< a ring
  std::size_t oldest_ = 0;
  Note last_;
};

}  // namespace stride::cli

#endif
