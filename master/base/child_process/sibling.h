// Copies of this process, and what would not be in them.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_SIBLING_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_SIBLING_H

#include <cstddef>

#include <sys/types.h>

namespace stride::isolation {

/// fork(), but for the parent: the copy is a child of this process's parent, which waits for it,
/// and does not notice which of the two was there first. Functions registered with pthread_atfork()
/// are not called, since to the program in it the copy is the same process. Only for a process with
/// one thread. Throws std::system_error if there can be none.
pid_t fork_sibling();

/// Threads of this process.
std::size_t thread_count();

/// Whether this process has started others that still run, or that it has not waited for.
bool has_children();

}  // namespace stride::isolation

#endif
