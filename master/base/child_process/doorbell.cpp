#include "master/base/child_process/doorbell.h"

#include <algorithm>
#include <ctime>

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace stride::isolation {
namespace {

constexpr std::chrono::nanoseconds kLeastSpin = std::chrono::microseconds(1);
constexpr std::uint32_t kRetry = 100;
constexpr std::chrono::microseconds kLongYield{500};
constexpr std::uint32_t kRetryYield = 100'000;

/// Without FUTEX_PRIVATE_FLAG: the other one is another process.
long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const std::timespec* timeout) {
  return ::syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), operation, value, timeout,
                   nullptr, 0);
}

bool has_several_cores() {
  cpu_set_t cores;
  return ::sched_getaffinity(0, sizeof cores, &cores) != 0 || CPU_COUNT(&cores) > 1;
}

}  // namespace

// All with the default order, std::memory_order_seq_cst: ringing reads whether there is a waiter
// after the ring is visible; a waiter is visible before it reads the rings, in the kernel.

void Doorbell::sleep(std::uint32_t rings, std::chrono::nanoseconds most) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(most);
  const std::timespec time{static_cast<std::time_t>(seconds.count()),
                           static_cast<long>((most - seconds).count())};
  is_awaited_.store(1);
  futex(rings_, FUTEX_WAIT, rings, &time);
  is_awaited_.store(0);
}

void Doorbell::wake() { futex(rings_, FUTEX_WAKE, 1, nullptr); }

Waiter::Waiter() : most_(has_several_cores() ? kMostSpin : kMostSpin.zero()), spin_(most_) {}

/// Where there are more units' processes than cores, the one that is waited for may need this core.
/// But one that has other work to do keeps it for milliseconds.
void Waiter::yield() {
  if (keeps_core_ > 0) {
    --keeps_core_;
    return;
  }
  const auto begin = Clock::now();
  ::sched_yield();
  if (Clock::now() - begin > kLongYield) keeps_core_ = kRetryYield;
}

void Waiter::note_vain() {
  const bool retries = ++in_vain_ % kRetry == 0;
  spin_ = retries ? most_ : std::max(spin_ / 2, kLeastSpin);
}

}  // namespace stride::isolation
