#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_INTERRUPTION_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_INTERRUPTION_H

#include <array>
#include <csignal>

namespace stride::cli {

/// During its lifetime the first signal that asks for the end only sets flag(): SIGINT, SIGTERM,
/// SIGHUP, and what batch systems, timers and limits of processor time send. A second one ends the
/// process, after the lines that files hold in memory were written. One that comes from code in
/// this process, such as that of a unit, is an error of a guarded process (CrashGuard). SIGPIPE
/// does not end it: writing fails instead.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Not 0 after a signal.
  static const volatile std::sig_atomic_t& flag();

 private:
  struct Handled {
    int signal;
    struct sigaction before;
  };
  std::array<Handled, 8> handled_{{{SIGINT, {}},
                                   {SIGTERM, {}},
                                   {SIGHUP, {}},
                                   {SIGXCPU, {}},
                                   {SIGUSR1, {}},
                                   {SIGUSR2, {}},
                                   {SIGALRM, {}},
                                   {SIGPIPE, {}}}};
};

}  // namespace stride::cli

#endif
