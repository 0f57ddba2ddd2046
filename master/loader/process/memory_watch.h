// The limit of the memory that all processes of a unit take together.
#ifndef STRIDE_MASTER_LOADER_PROCESS_MEMORY_WATCH_H
#define STRIDE_MASTER_LOADER_PROCESS_MEMORY_WATCH_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "master/base/child_process/memory_use.h"

namespace stride::isolation {

/// What a unit's processes may take together.
struct MemoryAllowance {
  std::optional<std::uint64_t> limit{};          ///< [byte]; nothing = no limit
  std::vector<std::filesystem::path> folders{};  ///< to which they can write
};

/// Measures the children of this process, with theirs, from time to time: so that it takes a
/// hundredth of the time at most, and at most 100 times in a second. It catches what the limit of a
/// process (limit_memory()) does not: memory that is shared, files in memory, and several
/// processes.
class MemoryWatch {
 public:
  /// To be made before there is a child: what this process has allocated, and what is in the
  /// folders, does not count.
  explicit MemoryWatch(const MemoryAllowance& allowance);

  /// How long it takes until the next measurement [ms]; -1: there is none.
  int pause() const;
  /// If it is time, measures. Returns what the processes have taken since, if that is above the
  /// limit [byte].
  std::optional<std::uint64_t> excess();

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<std::uint64_t> measure() const;

  std::optional<std::uint64_t> limit_;
  std::optional<MemoryUse> use_;
  std::uint64_t before_ = 0;  ///< there was so much of it already
  Clock::time_point next_{};
};

}  // namespace stride::isolation

#endif
