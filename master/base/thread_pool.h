// Threads that do one batch of work together with the thread that hands it out.
#ifndef STRIDE_MASTER_BASE_THREAD_POOL_H
#define STRIDE_MASTER_BASE_THREAD_POOL_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <vector>

namespace stride::core {

/// All functions are called from the thread that made the pool; only the tasks run on the others.
///
/// A waiting thread spins for 0.1 ms at most, then sleeps. It spins less where that was in
/// vain, but for one time in a hundred, to find out whether it still is. A worker starts with the
/// floating-point environment of the thread that makes the pool, and takes no asynchronous signal,
/// so handlers run elsewhere.
class ThreadPool {
 public:
  /// Starts `threads` - 1 workers. Throws Error (Run) if the system refuses.
  explicit ThreadPool(std::size_t threads);
  /// Ends the workers; not to be called by a task.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// The workers and the calling thread.
  std::size_t threads() const { return workers_.size() + 1; }

  /// Calls task(0) on this thread and task(k) on worker k, always the same thread for the same k,
  /// for each k below `count`, which is threads() at most. Returns when all of them have returned;
  /// what they wrote is visible then, as what was written before is to them. A task must not throw.
  /// Neither allocates nor locks.
  template <class Task>
  void run(std::size_t count, const Task& task) {
    static_assert(std::is_nothrow_invocable_v<const Task&, std::size_t>);
    run_batch(
        count,
        [](const void* object, std::size_t k) noexcept { (*static_cast<const Task*>(object))(k); },
        &task);
  }

  /// How long a batch takes in which nothing is to be done: the median of several, one after the
  /// other.
  std::chrono::nanoseconds measure_hand_over();

 private:
  using Call = void (*)(const void* task, std::size_t k) noexcept;

  /// How one thread waits.
  struct Waiter {
    std::chrono::nanoseconds most{};  ///< that it spins
    std::chrono::nanoseconds spin = most;
    std::uint32_t in_vain = 0;

    void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value);
  };
  /// On a cache line of its own, so that waiting for one does not slow the others down.
  struct alignas(64) Worker {
    std::atomic<std::uint32_t> batches = 0;  ///< handed to it; a change wakes it up
    std::thread thread;
  };

  void run_batch(std::size_t count, Call call, const void* task);
  void work(std::size_t k, Waiter waiter);
  void stop();

  Waiter waiter_;  ///< of the calling thread
  std::vector<Worker> workers_;
  Call call_ = nullptr;  ///< null: the workers are to end
  const void* task_ = nullptr;
  alignas(64) std::atomic<std::uint32_t> unfinished_ = 0;  ///< workers of the present batch
};

}  // namespace stride::core

#endif
