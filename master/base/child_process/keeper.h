// A process between another one and work that may turn against its parent.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_KEEPER_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_KEEPER_H

#include <optional>
#include <string>

#include <sys/types.h>

namespace stride::isolation {

/// To be called in a fresh fork of `parent`, which leads a process group of its own from here on.
/// Forks, and returns in the fork, with the id of this process, which stays as its keeper: it ends
/// when the fork has ended, or by a SIGTERM of its parent, or when its parent ends; before that it
/// ends all processes that the fork has left, those that have left its session, too, and then it
/// writes into `report` how the fork has ended. No other signal but SIGKILL does anything to it.
/// Throws std::system_error if there can be no fork.
pid_t go_on_kept(pid_t parent, int report);

/// In a process that is kept: whether the limits of its keeper are not what they were. A fork that
/// is kept by another one has that one.
bool is_keeper_limited();

/// How what was kept has ended, as waitpid() has it: takes the keeper's report away from the end of
/// what was written there. Nothing if there is none, for the keeper was killed, or if the keeper
/// found itself limited (setrlimit), as by what it kept.
std::optional<int> take_report(std::string& text);

}  // namespace stride::isolation

#endif
