#include "master/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <system_error>

#include <fmt/format.h>
#include <pthread.h>

#include "master/base/blocked_signals.h"
#include "master/base/error.h"

namespace stride::core {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer than the exchange between two steps takes; sleeping and waking up costs as much again.
constexpr std::chrono::microseconds kMostSpin{100};
constexpr std::chrono::microseconds kLeastSpin{1};
constexpr std::uint32_t kRetry = 100;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace

ThreadPool::ThreadPool(std::size_t threads)
    // where there are more threads than cores, a spinning thread only keeps the others from working
    : waiter_{threads <= std::thread::hardware_concurrency() ? kMostSpin : kMostSpin.zero()},
      workers_(std::max<std::size_t>(threads, 1) - 1) {
  const BlockedSignals blocked;
  try {
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      workers_[i].thread = std::thread([this, i] { work(i + 1, waiter_); });
    }
  } catch (const std::system_error& failure) {
    stop();
    fail_run({}, fmt::format("cannot start {} threads: {}", threads, failure.what()),
             "ask for fewer threads");
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  call_ = nullptr;
  for (Worker& worker : workers_) {
    if (!worker.thread.joinable()) continue;
    ++worker.batches;
    worker.batches.notify_one();
    worker.thread.join();
  }
}

// The counters are changed with the default order, std::memory_order_seq_cst: notify_one() looks
// whether anybody sleeps, and must not do so before the change can be seen.

void ThreadPool::run_batch(std::size_t count, Call call, const void* task) {
  call_ = call;
  task_ = task;
  unfinished_ = static_cast<std::uint32_t>(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    ++workers_[i].batches;
    workers_[i].batches.notify_one();
  }
  call(task, 0);
  while (const std::uint32_t left = unfinished_.load(std::memory_order_acquire)) {
    waiter_.wait_while(unfinished_, left);
  }
}

void ThreadPool::work(std::size_t k, Waiter waiter) {
  ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, nullptr);  // a task may leave one pending
  const Worker& worker = workers_[k - 1];
  for (std::uint32_t batch = 0;; ++batch) {
    waiter.wait_while(worker.batches, batch);
    if (call_ == nullptr) return;
    call_(task_, k);
    if (--unfinished_ == 0) unfinished_.notify_one();
  }
}

// Spinning in vain is worst where the other thread has no core to run on, for then it keeps it from
// running at all.
void ThreadPool::Waiter::wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) {
  const auto enough = Clock::now() + spin;
  do {
    for (int i = 0; i < 64; ++i) {
      if (word.load(std::memory_order_acquire) != value) {
        spin = std::min(2 * spin, most);
        return;
      }
      pause();
    }
  } while (Clock::now() < enough);
  const bool retries = ++in_vain % kRetry == 0;
  spin = retries ? most : std::min(std::max<std::chrono::nanoseconds>(spin / 2, kLeastSpin), most);
  word.wait(value, std::memory_order_acquire);
}

std::chrono::nanoseconds ThreadPool::measure_hand_over() {
  std::array<std::chrono::nanoseconds, 33> times;
  for (auto& time : times) {
    const auto began = Clock::now();
    run(threads(), [](std::size_t) noexcept {});
    time = Clock::now() - began;
  }
  const auto middle = times.begin() + times.size() / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace stride::core
