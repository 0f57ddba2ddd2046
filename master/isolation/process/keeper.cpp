#include "master/isolation/process/keeper.h"

#include <csignal>
#include <optional>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/isolation/process/children.h"
#include "master/isolation/process/descriptor.h"
#include "master/isolation/process/sibling.h"
#include "master/isolation/process/surroundings.h"
#include "master/util/outliving_memory.h"

namespace stride::isolation {
namespace {

/// How a process has ended that SIGTERM has ended, as waitpid() has it.
constexpr int kTerminated = SIGTERM;

sigset_t block_watched_signals() {
  sigset_t watched;
  ::sigemptyset(&watched);
  ::sigaddset(&watched, SIGCHLD);
  ::sigaddset(&watched, SIGTERM);
  ::sigprocmask(SIG_BLOCK, &watched, nullptr);
  return watched;
}

/// How that process has ended, if it is among those that have.
std::optional<int> take_ended(pid_t wanted) {
  std::optional<int> how;
  int status = 0;
  for (pid_t child = 0; (child = ::waitpid(-1, &status, WNOHANG)) > 0;) {
    if (WIFSTOPPED(status)) {
      let_go(child, status);
    } else if (child == wanted) {
      how = status;
    }
  }
  return how;
}

int await_end(pid_t kept, const sigset_t& watched) {
  for (;;) {
    int signal = 0;
    if (::sigwait(&watched, &signal) == 0 && signal == SIGTERM) return kTerminated;
    if (const auto how = take_ended(kept)) return *how;
  }
}

void end_all_that_is_left() {
  int ignored = 0;
  while (has_children() && kill_children_of(::getpid())) {
    if (::waitpid(-1, &ignored, 0) < 0) return;
  }
}

[[noreturn]] void end_as(int status) {
  if (WIFSIGNALED(status)) {
    reset_signal_handlers();
    ::kill(::getpid(), WTERMSIG(status));
  }
  ::_exit(WEXITSTATUS(status));
}

}  // namespace

pid_t go_on_kept(pid_t parent) {
  ::setpgid(0, 0);
  core::OutlivingMemory::leave();
  reset_signal_handlers();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const sigset_t watched = block_watched_signals();
  end_with(parent, SIGTERM);
  const pid_t self = ::getpid();
  const pid_t kept = ::fork();
  if (kept < 0) fail("fork");
  if (kept == 0) return self;
  const int how = await_end(kept, watched);
  end_all_that_is_left();
  end_as(how);
}

}  // namespace stride::isolation
