// The children of any process, as the kernel lists them.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_CHILDREN_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_CHILDREN_H

#include <optional>
#include <vector>

#include <sys/types.h>

namespace stride::isolation {

/// A thread of the process that has not ended: its first one may have, by a system call of its own,
/// and then the files of /proc/PROCESS are empty, but not those of the thread. Nothing if the
/// process has ended.
std::optional<pid_t> living_thread(pid_t process);

/// Those that any of its threads has started or adopted, with those that have ended and have not
/// been waited for. Nothing if there is no such process, or no such list.
std::optional<std::vector<pid_t>> children_of(pid_t process);

/// Its children, theirs, and so on, without the process itself.
std::vector<pid_t> descendants_of(pid_t process);

/// Sends SIGKILL to its children; returns whether one of them had not ended. To be called again
/// until it returns false: a subreaper adopts the children of those that end.
bool kill_children_of(pid_t process);

/// For a child that waitpid() says is stopped: some code in it has made this process its debugger
/// (PTRACE_TRACEME), for which its signals wait. From here on they have their effect.
void let_go(pid_t child, int status) noexcept;

}  // namespace stride::isolation

#endif
