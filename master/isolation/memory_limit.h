#ifndef STRIDE_MASTER_ISOLATION_MEMORY_LIMIT_H
#define STRIDE_MASTER_ISOLATION_MEMORY_LIMIT_H

#include <cstdint>

namespace stride::host {

/// Lets this process have so many bytes of data more than it has now: heap, stacks of threads, and
/// other private memory that can be written to (RLIMIT_DATA). Beyond that there is no memory.
void limit_memory(std::uint64_t bytes);

}  // namespace stride::host

#endif
