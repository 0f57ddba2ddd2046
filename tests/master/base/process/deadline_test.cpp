#include "master/base/process/deadline.h"

#include <csignal>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

using stride::core::Deadline;
using namespace std::chrono_literals;

namespace {

/// How a fork ends that does this.
template <class Work>
int status_of(Work&& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace

TEST_CASE("a process is killed at its deadline, whatever it does") {
  const int status = status_of([] {
    std::signal(SIGALRM, SIG_IGN);
    const Deadline deadline(10ms);
    for (;;) std::this_thread::sleep_for(1s);
  });
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGKILL);
}

TEST_CASE("a deadline that is over before it comes, or that there is not, kills nothing") {
  CHECK(status_of([] {
          { const Deadline deadline(100ms); }
          const Deadline none({});
          std::this_thread::sleep_for(200ms);
        }) == 0);
}
