#include "master/base/process/fork_mark.h"

#include <csignal>

#include <catch2/catch.hpp>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using stride::core::ForkMark;

TEST_CASE("a process that is made by fork() or by a system call lacks the mark") {
  ForkMark::set();
  const bool is_by_system_call = GENERATE(false, true);
  const pid_t copy =
      is_by_system_call
          ? static_cast<pid_t>(::syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr))
          : ::fork();
  if (copy == 0) {
    const bool was_set = ForkMark::is_set();
    ForkMark::set();
    ::_exit(!was_set && ForkMark::is_set() ? 0 : 1);
  }
  int status = -1;
  ::waitpid(copy, &status, 0);
  CHECK(status == 0);
  CHECK(ForkMark::is_set());
}
