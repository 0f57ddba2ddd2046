#ifndef STRIDE_MASTER_BASE_BLOCKED_SIGNALS_H
#define STRIDE_MASTER_BASE_BLOCKED_SIGNALS_H

#include <csignal>

namespace stride::core {

/// While it exists, threads that are started take no signal but those that their own code raises.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t signals;
    sigfillset(&signals);
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS}) {
      sigdelset(&signals, own);
    }
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace stride::core

#endif
