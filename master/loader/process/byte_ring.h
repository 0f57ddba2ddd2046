#ifndef STRIDE_MASTER_LOADER_PROCESS_BYTE_RING_H
#define STRIDE_MASTER_LOADER_PROCESS_BYTE_RING_H

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stride::isolation {

/// Bytes on their way from one process to another, in shared memory: one thread writes, one reads,
/// and neither waits. Its content outlives the writer.
class ByteRing {
 public:
  static constexpr std::size_t kSize = std::size_t{1} << 16;

  /// Writes as much of it as there is room for, and returns how much that was.
  std::size_t write(std::string_view bytes);
  bool is_empty() const { return read_.load() == written_.load(std::memory_order_acquire); }
  std::size_t room() const;
  /// Appends everything that is there.
  void read(std::string& bytes);

 private:
  // both only grow; the writer is not trusted: a difference above kSize counts as kSize
  alignas(64) std::atomic<std::uint64_t> written_ = 0;
  alignas(64) std::atomic<std::uint64_t> read_ = 0;
  std::array<char, kSize> bytes_{};
};

}  // namespace stride::isolation

#endif
