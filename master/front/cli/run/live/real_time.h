// A run that keeps up with the wall clock, and is not ahead of it.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_LIVE_REAL_TIME_H
#define STRIDE_MASTER_FRONT_CLI_RUN_LIVE_REAL_TIME_H

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <stride/time.h>

#include "master/engine/port/observer.h"

namespace stride::cli {

/// From the text of --realtime: simulated seconds in one of the wall clock, above 0. Throws
/// core::Error (Input).
double parse_real_time_factor(const std::string& text);

/// Where the wall clock comes from, and how it is waited for.
struct WallClock {
  using Instant = std::chrono::steady_clock::time_point;
  std::function<Instant()> now = std::chrono::steady_clock::now;
  /// Returns at this instant; earlier for a signal.
  std::function<void(Instant)> wait_until;

  WallClock();
};

/// Waits at each communication point for its instant, counted from the first one. A run that is
/// late goes on as fast as it can until it is not.
class RealTime : public core::Observer {
 public:
  /// `interrupted`: not 0 when nothing is to be waited for any longer; it must outlive the object.
  RealTime(double factor, const volatile std::sig_atomic_t& interrupted, WallClock clock = {});

  /// What is done about once a second, where there is time for it.
  void set_meanwhile(std::function<void()> meanwhile) { meanwhile_ = std::move(meanwhile); }

  void on_communication_point(Time time) override;

  /// The next communication point is the first one, such as that of a fork.
  void restart() { origin_.reset(); }

  /// How late it was; empty before the run has begun.
  std::string text() const;
  /// Whether it ended later than people notice.
  bool is_late() const;

 private:
  using Seconds = std::chrono::duration<double>;

  struct Origin {
    Time time;
    WallClock::Instant wall;
  };

  const double factor_;
  const volatile std::sig_atomic_t& interrupted_;
  const WallClock clock_;
  std::function<void()> meanwhile_{};
  WallClock::Instant meanwhile_done_{};
  std::optional<Origin> origin_;
  Seconds lag_{}, greatest_lag_{};
  Time latest_{};  ///< where the lag was greatest
};

}  // namespace stride::cli

#endif
