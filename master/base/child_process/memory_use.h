// The memory that several processes take together.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_MEMORY_USE_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_MEMORY_USE_H

#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <vector>

#include <sys/types.h>

namespace stride::isolation {

/// Measures what processes and folders have in memory, resident or swapped out: private memory,
/// memory that is shared, and files that are kept in memory (memfd_create(), tmpfs), mapped or not,
/// if a process has them open or if they are in the folders. Pages of files on a disk do not count,
/// the kernel can drop them.
///
/// Not seen: files in memory that are neither open nor in the folders, or on their way through a
/// socket, and buffers of pipes and sockets.
class MemoryUse {
 public:
  /// Looks which file systems are in memory, and which of the folders are there.
  explicit MemoryUse(const std::vector<std::filesystem::path>& folders);

  /// Each page once [byte]. It goes through all pages of all processes.
  std::uint64_t of(std::span<const pid_t> processes) const;
  /// At least as much as of(), since it counts a page once for each process that has it. Cheap.
  std::uint64_t bound(std::span<const pid_t> processes) const;

 private:
  struct Files;

  bool is_in_memory(dev_t device) const { return devices_.contains(device); }
  void add_open_files(pid_t process, Files& files) const;
  void add_folders(Files& files) const;
  void add_mappings(pid_t process, Files& files, std::uint64_t& swapped) const;

  std::set<dev_t> devices_;  ///< file systems in memory
  std::vector<std::filesystem::path> folders_;
};

}  // namespace stride::isolation

#endif
