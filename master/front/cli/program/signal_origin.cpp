#include "master/front/cli/program/signal_origin.h"

#include <sys/time.h>
#include <unistd.h>

#include "master/base/process/signal_state.h"

namespace stride::cli {
namespace {

bool has_alarm() {
  itimerval alarm{};
  return ::getitimer(ITIMER_REAL, &alarm) == 0 &&
         (alarm.it_value.tv_sec != 0 || alarm.it_value.tv_usec != 0);
}

/// Before main(), and so before any unit.
const bool had_alarm = has_alarm();

/// Which the kernel sends for what the process has asked for.
bool is_requested(int signal) {
  return (signal == SIGALRM && !had_alarm) || signal == SIGVTALRM || signal == SIGPROF ||
         signal == SIGIO;
}

}  // namespace

SignalOrigin origin_of(int signal, const siginfo_t& info) noexcept {
  switch (info.si_code) {
    case SI_USER:
    case SI_TKILL:
    case SI_QUEUE:
      return info.si_pid == ::getpid() ? SignalOrigin::Call : SignalOrigin::Outside;
    case SI_TIMER:
    case SI_MESGQ:
    case SI_ASYNCIO:
      return SignalOrigin::Process;
    default:
      break;
  }
  if (core::is_crash(signal)) return SignalOrigin::Call;
  return is_requested(signal) ? SignalOrigin::Process : SignalOrigin::Outside;
}

}  // namespace stride::cli
