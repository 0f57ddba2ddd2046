// Whether the present function of a unit has made this process, by whatever means.
#ifndef STRIDE_MASTER_BASE_PROCESS_FORK_MARK_H
#define STRIDE_MASTER_BASE_PROCESS_FORK_MARK_H

#include <atomic>

namespace stride::core {

/// A mark of this process that a copy of it does not have, be it made by fork() or by a system call
/// (MADV_WIPEONFORK); a process that shares its memory has it. Without such memory (before Linux
/// 4.14) copies have it, too. Setting and reading it cost one access to memory.
class ForkMark {
 public:
  [[gnu::always_inline]] static void set() noexcept { byte_.store(1, std::memory_order_relaxed); }
  [[gnu::always_inline]] static bool is_set() noexcept {
    return byte_.load(std::memory_order_relaxed) != 0;
  }

 private:
  static std::atomic<char>& byte_;
};

}  // namespace stride::core

#endif
