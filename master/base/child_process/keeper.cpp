#include "master/base/child_process/keeper.h"

#include <csignal>
#include <cstring>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/children.h"
#include "master/base/child_process/descriptor.h"
#include "master/base/child_process/process_limits.h"
#include "master/base/child_process/sibling.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/outliving_memory.h"

namespace stride::isolation {
namespace {

/// Behind all that was written by what it keeps.
struct Report {
  char mark[8] = {};
  int status = 0;
  int is_limited = 0;
};
constexpr char kMark[sizeof Report::mark] = "\0KEPT\0";

/// Of the process that keeps this one.
struct Keeper {
  pid_t process;
  ProcessLimits limits;
};
std::optional<Keeper> own_keeper;

/// All that can be: what a case sends to its parent is not for this one.
void block_signals() {
  sigset_t all;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
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

/// Nothing if the parent wants its end, or has ended.
std::optional<int> await_end(pid_t kept, pid_t parent) {
  sigset_t watched;
  ::sigemptyset(&watched);
  ::sigaddset(&watched, SIGCHLD);
  ::sigaddset(&watched, SIGTERM);
  for (;;) {
    siginfo_t info{};
    const int signal = ::sigwaitinfo(&watched, &info);
    if (signal == SIGTERM && (info.si_pid == parent || ::getppid() != parent)) return std::nullopt;
    if (const auto how = take_ended(kept)) return how;
  }
}

void end_all_that_is_left() {
  int ignored = 0;
  while (has_children() && kill_children_of(::getpid())) {
    if (::waitpid(-1, &ignored, 0) < 0) return;
  }
}

void write_report(int file, int status, bool is_limited) {
  Report report{.status = status, .is_limited = is_limited};
  std::memcpy(report.mark, kMark, sizeof kMark);
  write_all(file, reinterpret_cast<const char*>(&report), sizeof report);
}

}  // namespace

pid_t go_on_kept(pid_t parent, int report) {
  ::setpgid(0, 0);
  core::OutlivingMemory::leave();
  reset_signal_handlers();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  block_signals();
  end_with(parent, SIGTERM);
  own_keeper = {::getpid(), ProcessLimits()};
  const pid_t kept = ::fork();
  if (kept < 0) fail("fork");
  if (kept == 0) return own_keeper->process;
  const auto how = await_end(kept, parent);
  end_all_that_is_left();
  if (how) write_report(report, *how, is_keeper_limited());
  ::_exit(0);
}

bool is_keeper_limited() {
  return own_keeper && !(ProcessLimits(own_keeper->process) == own_keeper->limits);
}

std::optional<int> take_report(std::string& text) {
  Report report;
  if (text.size() < sizeof report) return std::nullopt;
  const std::size_t rest = text.size() - sizeof report;
  std::memcpy(&report, text.data() + rest, sizeof report);
  if (std::memcmp(report.mark, kMark, sizeof kMark) != 0) return std::nullopt;
  text.resize(rest);
  if (report.is_limited != 0) return std::nullopt;
  return report.status;
}

}  // namespace stride::isolation
