// States of a unit that has none: forks of its process.
#ifndef STRIDE_MASTER_LOADER_PROCESS_SNAPSHOTS_H
#define STRIDE_MASTER_LOADER_PROCESS_SNAPSHOTS_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "master/base/child_process/open_files.h"
#include "master/base/error.h"
#include "master/loader/process/snapshot_board.h"

namespace stride::isolation {

struct SnapshotOptions {
  core::Context context{};       ///< of the unit, for errors
  std::vector<int> own_files{};  ///< of the master, open in the process
  /// What all snapshots may have to themselves [byte]; nothing = no limit.
  std::optional<std::uint64_t> memory_limit{};
};

/// Saves and restores the process that it is in. A snapshot is a fork of it that sleeps; to restore
/// one the process ends, and the snapshot forks another that goes on where it was itself forked. So
/// it can be restored any number of times. Pages are shared until one of them writes into them.
///
/// All these processes are children of one parent, the supervisor, and end with it. What a fork
/// does not hold cannot be saved: threads and processes of the unit are refused; its open files are
/// set back to the positions and lengths that they had.
class Snapshots {
 public:
  /// `active` names the active process of the unit, `supervisor` its parent.
  Snapshots(SnapshotBoard& board, std::atomic<pid_t>& active, pid_t supervisor,
            SnapshotOptions options);

  /// Keeps the process in the slot, instead of what was kept there. Returns false; and once more
  /// true, in another process, for each restore of what was kept. The content of this process's
  /// stack and heap is then as it was; what it shares with others is not. Throws core::Error (Run)
  /// at `time` if there can be no snapshot, or no other process can become active when one is
  /// restored.
  bool save(std::size_t slot, std::optional<Time> time = std::nullopt);

  /// Ends this process, and goes on where what the slot holds was saved. Throws core::Error (Run)
  /// if it holds nothing.
  [[noreturn]] void restore(std::size_t slot, std::optional<Time> time = std::nullopt);

  /// Looks how much memory the snapshots have to themselves. Throws core::Error (Run) if it is more
  /// than they may have.
  void measure();

 private:
  using Entry = SnapshotBoard::Entry;
  using Clock = std::chrono::steady_clock;

  void check(std::size_t slot) const;
  void refuse_company() const;
  std::uint32_t find_free_entry();
  bool freeze(Entry& entry);
  bool take_over();
  void discard(std::size_t slot);
  void count();
  void measure_sometimes();
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;

  SnapshotBoard& board_;
  std::atomic<pid_t>& active_;
  pid_t supervisor_;
  SnapshotOptions options_;
  OpenFiles files_;
  Clock::time_point next_measurement_{};
};

}  // namespace stride::isolation

#endif
