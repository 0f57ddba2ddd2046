// A process's memory: as the kernel reports it (proc(5)), and its limit.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_PROCESS_MEMORY_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_PROCESS_MEMORY_H

#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace stride::isolation {

/// The most that was resident so far [byte]; 0 if it is not known.
std::uint64_t most_memory(pid_t process);

/// What is resident and no other process has [byte]; 0 if it is not known. It goes through all
/// pages of the process.
std::uint64_t private_memory(pid_t process);

/// What it has allocated, and may write to alone, resident or not [byte]; 0 if it is not known.
std::uint64_t data_memory(pid_t process);

/// What is resident of its private memory, with a page that n processes share as one nth of it, and
/// of its huge pages [byte]; nothing if this process must not look. It goes through all pages.
std::optional<std::uint64_t> proportional_memory(pid_t process);

/// All of it that is resident or swapped out, but for pages of files [byte]; 0 if it is not known.
/// Shared pages count as private ones do. Cheap.
std::uint64_t unshared_bound(pid_t process);

/// Lets this process have so many bytes of data more than it has now: heap, stacks of threads, and
/// other private memory that can be written to (RLIMIT_DATA). Beyond that there is no memory.
void limit_memory(std::uint64_t bytes);

}  // namespace stride::isolation

#endif
