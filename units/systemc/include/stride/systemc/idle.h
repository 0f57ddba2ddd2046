// Skipping a device's idle time.
#ifndef STRIDE_SYSTEMC_IDLE_H
#define STRIDE_SYSTEMC_IDLE_H

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <stride/systemc/kernel.h>
#include <stride/systemc/state_watch.h>
#include <stride/time.h>

namespace stride::systemc {

/// What a module makes of the edges of its clock that are skipped: nothing. It has no counter and
/// no divider that goes on while it is idle.
struct CountsNothing {};
inline CountsNothing counts_nothing() { return {}; }
/// It divides its clock, and is what it was after each period of the slowest divided one. Each skip
/// is a whole multiple.
struct RepeatsEvery {
  Duration period;
};
inline RepeatsEvery repeats_every(Duration period) { return {period}; }
/// What has been skipped just now, for a function that lets the module catch up.
struct Skipped {
  Duration time;
  std::int64_t cycles;  ///< of the unit's clock, the fastest of several; 0 without one
};

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
///
/// With a StateWatch a skip needs more than the device's word: a clock period that has left it as
/// it was. If 16 in a row do not, its idle time is simulated until one does. has_settled() is the
/// same for promises.
class IdleSkipper {
 public:
  struct Statistics {
    std::int64_t skips = 0;
    Duration skipped{};
    Duration longest{};
  };

  /// Where the device declared itself idle and went on changing.
  struct Unrest {
    Time when;
    std::string place;  ///< see StateWatch
  };

  IdleSkipper(Kernel& kernel, IdleRules& rules, std::optional<StateWatch> watch = std::nullopt)
      : kernel_(kernel), rules_(rules), watch_(std::move(watch)) {}

  /// As Kernel::advance(); no skip is longer than `max_skip`.
  Time advance(Time to, bool may_stop_early, Duration max_skip);

  const Statistics& statistics() const { return statistics_; }
  /// The device declared itself idle, but SystemC had something to notify at this instant that is
  /// no edge of a clock: a wait(time) or notify(delay) where a Timer should be. Such time is
  /// simulated. Where the clock that goes on is no sc_clock, one within the next period is taken
  /// for its edge, and comes later by what is skipped.
  std::optional<Time> obstacle() const { return obstacle_; }
  /// The first one.
  const std::optional<Unrest>& unrest() const { return unrest_; }
  /// The last period that the last advance() compared has left it as it was; without a StateWatch
  /// its word is enough.
  bool has_settled() const { return !watch_ || has_settled_; }

 private:
  static constexpr int kMostChanges = 16;  ///< what was begun before may end in some cycles

  enum class Comparison { None, Same, Changed };

  Duration look(Time to, Duration max_skip);
  /// Since the state was noted.
  bool is_period_over() const;
  /// Of the state a period ago, if it was noted, with the present one.
  Comparison compare_states();
  /// The last periods that it spent idle have changed it.
  bool is_restless() const { return changes_ >= kMostChanges; }
  bool note_state();
  void skip(Duration skipped);
  Duration simulated() const { return kernel_.now().time_since_epoch() - kernel_.skipped(); }
  bool is_obstructed();
  Duration room(Time to, Duration max_skip) const;
  Duration lead() const;
  Duration until_next_check();

  Kernel& kernel_;
  IdleRules& rules_;
  std::optional<StateWatch> watch_;
  Duration watched_at_{};  ///< simulated() when the watch noted the state
  int changes_ = 0;        ///< in so many periods in a row
  bool has_settled_ = false;
  std::optional<Unrest> unrest_;
  Statistics statistics_;
  std::optional<Time> obstacle_;
  Time obstructed_until_ = Time::min();
};

/// For the log.
std::string to_text(const IdleSkipper::Statistics& statistics);
std::string obstacle_text(Time obstacle);
std::string unrest_text(const IdleSkipper::Unrest& unrest);

}  // namespace stride::systemc

#endif
