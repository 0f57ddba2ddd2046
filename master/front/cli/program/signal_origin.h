// Whether a signal comes from code in this process, such as that of a unit, or from elsewhere.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_SIGNAL_ORIGIN_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_SIGNAL_ORIGIN_H

#include <csignal>

namespace stride::cli {

enum class SignalOrigin {
  Call,     ///< what this thread does: a fault, raise() or kill()
  Process,  ///< what this process has set up before: a timer, or notices about an open file
  Outside,  ///< another process, the terminal, or a limit of processor time
};

/// Of a signal that a handler with SA_SIGINFO gets. An alarm that was set before the program began,
/// as some programs limit the time of others, is from outside. For signal handlers.
SignalOrigin origin_of(int signal, const siginfo_t& info) noexcept;

}  // namespace stride::cli

#endif
