#ifndef STRIDE_MASTER_LOADER_PROCESS_SNAPSHOT_BOARD_H
#define STRIDE_MASTER_LOADER_PROCESS_SNAPSHOT_BOARD_H

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <sys/types.h>

#include "master/base/child_process/doorbell.h"

namespace stride::isolation {

/// Only ever called by one process at a time for the same number.
inline void raise_to(std::atomic<std::uint64_t>& most, std::uint64_t value) {
  if (value > most) most = value;
}

/// The snapshots of a unit's process, and their orders. In shared memory, since
/// the active process of the unit needs it, however far it was taken back.
struct SnapshotBoard {
  static constexpr std::size_t kSlots = 16;
  /// One that was ordered to end keeps its entry until the supervisor has seen its end.
  static constexpr std::size_t kEntries = 2 * kSlots;

  enum class State : std::uint32_t {
    Free,
    Frozen,
    TakesOver,  ///< it was ordered to become the active process
    Ends,       ///< it was ordered to end
    Lost,       ///< it has ended untold
  };
  /// Of one snapshot.
  struct Entry {
    std::atomic<State> state = State::Free;
    std::atomic<pid_t> process = 0;
    std::atomic<std::uint64_t> memory = 0;  ///< what it had to itself when it was last measured
    Doorbell doorbell;                      ///< for when its state has changed
  };

  std::array<Entry, kEntries> entries;
  std::array<std::atomic<std::uint32_t>, kSlots> entry_of;  ///< counted from 1; 0: nothing is kept
  std::atomic<std::uint64_t> snapshots = 0;                 ///< that were made
  std::atomic<std::uint64_t> restores = 0;
  std::atomic<std::uint64_t> most_kept = 0;
  std::atomic<std::uint64_t> most_memory = 0;  ///< of all that were kept at a time [byte]

  SnapshotBoard() {
    for (auto& entry : entry_of) entry = 0;
  }

  /// For the supervisor: a process other than the active one has ended.
  void note_end(pid_t process);
};

}  // namespace stride::isolation

#endif
