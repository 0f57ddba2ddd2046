#include "master/front/cli/program/exit.h"

#include <csignal>

#include <unistd.h>

namespace stride::cli {

void end_by(int signal) noexcept {
  ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::raise(signal);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::_exit(kRunFailed);
}

}  // namespace stride::cli
