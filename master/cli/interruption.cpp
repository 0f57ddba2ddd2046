#include "master/cli/interruption.h"

#include "master/cli/crash_guard.h"
#include "master/util/output_file.h"

namespace stride::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// The second signal ends a run that reaches no communication point. One that a unit sends is an
/// error of the unit.
void note_interruption(int signal, siginfo_t* info, void*) {
  end_if_own(signal, *info);
  if (interrupted != 0) {
    core::OutputFile::rescue_all();
    ::signal(signal, SIG_DFL);
    ::raise(signal);
  }
  interrupted = 1;
}

/// A handler, since programs that units start would inherit SIG_IGN.
void do_nothing(int) {}

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  for (Handled& handled : handled_) {
    struct sigaction action {};
    if (handled.signal == SIGPIPE) {
      action.sa_handler = do_nothing;
    } else {
      action.sa_sigaction = note_interruption;
      action.sa_flags = SA_SIGINFO;
    }
    sigaction(handled.signal, nullptr, &handled.before);
    if (handled.before.sa_handler != SIG_IGN) sigaction(handled.signal, &action, nullptr);
  }
}

/// A unit's own handler stays: its timer may still run.
Interruption::~Interruption() {
  for (const Handled& handled : handled_) {
    struct sigaction now {};
    sigaction(handled.signal, nullptr, &now);
    const bool is_ours = now.sa_sigaction == note_interruption || now.sa_handler == do_nothing;
    if (is_ours) sigaction(handled.signal, &handled.before, nullptr);
  }
}

const volatile std::sig_atomic_t& Interruption::flag() { return interrupted; }

}  // namespace stride::cli
