// Skipping a device's idle time.
#ifndef STRIDE_SYSTEMC_IDLE_H
#define STRIDE_SYSTEMC_IDLE_H

#include <cstdint>
#include <optional>
#include <string>

#include <stride/systemc/kernel.h>
#include <stride/time.h>

namespace stride::systemc {

/// The idle times of a device. Called at rest, in the device's context.
class IdleRules {
 public:
  virtual ~IdleRules() = default;
  /// Nothing happens by itself until the next Timer, but for clocks.
  virtual bool idle() const = 0;
  /// Of the clocks that go on while it is idle: a skip is a whole multiple. Zero if there are none.
  virtual Duration clock_period() const = 0;
  /// How long from now on what on_skip() does is good enough.
  virtual Duration longest_skip() const = 0;
  /// Closes the time that was skipped just now.
  virtual void on_skip(Duration skipped) = 0;
};

/// Advances a kernel, and skips what is idle. A skip ends at least one picosecond before the next
/// Timer and before the end; between two of them, and after each input, a whole clock period is
/// simulated, or a picosecond where there is no clock. So clocks keep their phase, and an input
/// that is sampled at a clock's edge has been sampled.
///
/// A device that is not idle is looked at again after 10 us, or when it does something next if that
/// is later. Less than 1 us is simulated, which costs less than a skip.
class IdleSkipper {
 public:
  struct Statistics {
    std::int64_t skips = 0;
    Duration skipped{};
    Duration longest{};
  };

  IdleSkipper(Kernel& kernel, IdleRules& rules) : kernel_(kernel), rules_(rules) {}

  /// As Kernel::advance(); no skip is longer than `max_skip`.
  Time advance(Time to, bool may_stop_early, Duration max_skip);

  const Statistics& statistics() const { return statistics_; }
  /// The device declared itself idle, but SystemC had something to notify at this instant that is
  /// no edge of a clock: a wait(time) or notify(delay) where a Timer should be. Such time is
  /// simulated. Where the clock that goes on is no sc_clock, one within the next period is taken
  /// for its edge, and comes later by what is skipped.
  std::optional<Time> obstacle() const { return obstacle_; }

 private:
  bool skip(Time to, Duration max_skip);
  bool is_obstructed();
  Duration room(Time to, Duration max_skip) const;
  Duration lead() const;
  Duration until_next_check();

  Kernel& kernel_;
  IdleRules& rules_;
  Statistics statistics_;
  std::optional<Time> obstacle_;
  Time obstructed_until_ = Time::min();
};

/// For the log.
std::string to_text(const IdleSkipper::Statistics& statistics);
std::string obstacle_text(Time obstacle);

}  // namespace stride::systemc

#endif
