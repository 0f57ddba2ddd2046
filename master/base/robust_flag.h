#ifndef STRIDE_MASTER_BASE_ROBUST_FLAG_H
#define STRIDE_MASTER_BASE_ROBUST_FLAG_H

#include <atomic>
#include <cstdint>

namespace stride::core {

/// A flag in memory that other code may damage, which is unlikely to set it. For signal handlers
/// and several processes.
class RobustFlag {
 public:
  void set(bool is_set = true) noexcept {
    word_.store(is_set ? kSet : 0, std::memory_order_release);
  }
  explicit operator bool() const noexcept { return word_.load(std::memory_order_acquire) == kSet; }

 private:
  static constexpr std::uint64_t kSet = 0x5ba1'c0de'7e57'0e4d;

  std::atomic<std::uint64_t> word_{0};
};

}  // namespace stride::core

#endif
