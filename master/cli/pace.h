#ifndef STRIDE_MASTER_CLI_PACE_H
#define STRIDE_MASTER_CLI_PACE_H

#include <array>
#include <chrono>
#include <cstddef>

#include <stride/time.h>

namespace stride::cli {

/// The present speed of a run, over the last seconds of the wall clock. It differs from the mean
/// speed, since units are suspended at one time and busy at another.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  Pace(Clock::time_point now, Time time) : last_{now, time} { notes_.fill(last_); }

  /// In the order of both clocks.
  void note(Clock::time_point now, Time time);
  /// Simulated seconds per second of the wall clock; 0 before there are two entries.
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
