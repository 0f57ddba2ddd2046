// The wall clock, where reading it would take longer than what happens between.
#ifndef STRIDE_MASTER_BASE_SPARSE_CLOCK_H
#define STRIDE_MASTER_BASE_SPARSE_CLOCK_H

#include <algorithm>
#include <chrono>

namespace stride::core {

/// Reads the clock in some of the calls only, where they follow each other quickly.
class SparseClock {
 public:
  using Clock = std::chrono::steady_clock;

  explicit SparseClock(Clock::time_point now = Clock::now()) : now_(now) {}

  /// Whether it was read.
  bool read() {
    if (unread_ > 0) {
      --unread_;
      return false;
    }
    const Clock::time_point before = now_;
    now_ = Clock::now();
    const bool are_short = now_ - before < kShort * (between_ + 1);
    unread_ = between_ = are_short ? std::min(2 * between_ + 1, kMostUnread) : 0;
    return true;
  }
  /// As it was read last.
  Clock::time_point now() const { return now_; }

 private:
  static constexpr std::chrono::microseconds kShort{10};
  static constexpr int kMostUnread = 15;

  Clock::time_point now_;
  int between_ = 0;  ///< calls between two readings
  int unread_ = 0;   ///< the rest of them
};

}  // namespace stride::core

#endif
