#include "master/cli/interruption.h"

namespace stride::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note_interruption(int) { interrupted = 1; }

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  for (Handled& handled : handled_) {
    struct sigaction action {};
    action.sa_handler = note_interruption;
    action.sa_flags =
        SA_RESETHAND;  // a second signal ends a run that reaches no communication point
    sigaction(handled.signal, nullptr, &handled.before);
    if (handled.before.sa_handler != SIG_IGN) sigaction(handled.signal, &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (const Handled& handled : handled_) sigaction(handled.signal, &handled.before, nullptr);
}

const volatile std::sig_atomic_t& Interruption::flag() { return interrupted; }

}  // namespace stride::cli
