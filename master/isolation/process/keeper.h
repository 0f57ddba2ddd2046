// A process between another one and work that may turn against its parent.
#ifndef STRIDE_MASTER_ISOLATION_PROCESS_KEEPER_H
#define STRIDE_MASTER_ISOLATION_PROCESS_KEEPER_H

#include <sys/types.h>

namespace stride::isolation {

/// To be called in a fresh fork of `parent`, which leads a process group of its own from here on.
/// Forks, and returns in the fork, with the id of this process, which stays as its
/// keeper: it ends when the fork has ended, in the same way, or by a SIGTERM, or when its parent
/// ends; before that it ends all processes that the fork has left, those that have left its
/// session, too. Throws std::system_error if there can be no fork.
pid_t go_on_kept(pid_t parent);

}  // namespace stride::isolation

#endif
