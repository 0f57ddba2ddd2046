#include "master/base/child_process/surroundings.h"

#include <algorithm>
#include <csignal>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {

void reset_signal_handlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    if (signal != SIGXFSZ) ::signal(signal, SIG_DFL);  // it is ignored, so that writing fails
  }
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit nothing{0, 0};
  ::setrlimit(RLIMIT_CORE, &nothing);
}

void redirect_standard_files(int output) {
  const Descriptor empty(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  ::dup2(empty.number(), STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
}

void end_with(pid_t parent, int signal) {
  ::prctl(PR_SET_PDEATHSIG, signal);
  if (::getppid() != parent) ::_exit(1);
}

void close_other_files(std::initializer_list<int> kept) {
  std::vector<int> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  unsigned first = STDERR_FILENO + 1;
  for (const int file : sorted) {
    if (file < static_cast<int>(first)) continue;
    if (file > static_cast<int>(first)) ::close_range(first, static_cast<unsigned>(file) - 1, 0);
    first = static_cast<unsigned>(file) + 1;
  }
  ::close_range(first, ~0U, 0);
}

}  // namespace stride::isolation
