// How one process waits for another.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_DOORBELL_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_DOORBELL_H

#include <atomic>
#include <chrono>
#include <cstdint>

namespace stride::isolation {

/// A hint to the processor that this is a waiting loop.
inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// A futex in shared memory. One thread waits for a condition; another one, of any process, makes
/// it true and rings afterwards.
class Doorbell {
 public:
  void ring() {
    rings_.fetch_add(1);
    if (is_awaited_.load()) wake();
  }

  std::uint32_t rings() const { return rings_.load(); }
  /// Sleeps until rings() is another number than `rings`, the time is over, or a signal was
  /// handled.
  void sleep(std::uint32_t rings, std::chrono::nanoseconds most);

 private:
  void wake();

  std::atomic<std::uint32_t> rings_ = 0;
  std::atomic<std::uint32_t> is_awaited_ = 0;  ///< ring() need not call the kernel otherwise
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

/// How one side waits: it spins for a while, letting others onto its core, since a sleeping core
/// takes tens of microseconds to wake up, then it sleeps. It spins less where that was in vain, but
/// for one time in a hundred, to find out whether it still is; and never where there is one core
/// only.
class Waiter {
 public:
  /// What is waited for would have to take this long for a sleep to cost less.
  static constexpr std::chrono::microseconds kMostSpin{100};

  Waiter();

  /// Returns whether is_there() holds, which is looked at again and again for `most`, and whenever
  /// the doorbell rings.
  template <class Condition>
  bool wait(Doorbell& doorbell, std::chrono::nanoseconds most, Condition&& is_there) {
    if (spin(is_there)) return true;
    const std::uint32_t rings = doorbell.rings();
    if (is_there()) return true;
    doorbell.sleep(rings, most);
    return is_there();
  }

  /// The first part of it.
  template <class Condition>
  bool spin(Condition&& is_there) {
    if (is_there()) return true;
    if (most_ == most_.zero()) return false;
    const auto enough = Clock::now() + spin_;
    do {
      for (int i = 0; i < kGlances; ++i) {
        pause();
        if (is_there()) {
          spin_ = spin_ * 2 < most_ ? spin_ * 2 : most_;
          return true;
        }
      }
      yield();
    } while (Clock::now() < enough);
    note_vain();
    return false;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// So often it looks before anybody else is let onto the core.
  static constexpr int kGlances = 8;

  void yield();
  void note_vain();

  std::chrono::nanoseconds most_, spin_;
  std::uint32_t in_vain_ = 0;
  std::uint32_t keeps_core_ = 0;  ///< for so many further times
};

}  // namespace stride::isolation

#endif
