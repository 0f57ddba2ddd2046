#include "master/front/cli/program/interruption.h"

#include <cstdint>
#include <ctime>
#include <utility>

#include "master/base/files/output_file.h"
#include "master/front/cli/program/crash_guard.h"

namespace stride::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

std::int64_t last_interruption = 0;  ///< [ns]

/// Of one request, which may come twice: from the sender, and by way of the process that watches
/// this one.
bool is_repeated() {
  constexpr std::int64_t kApart = 100'000'000;  // [ns]
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t time = now.tv_sec * 1'000'000'000 + now.tv_nsec;
  return time - std::exchange(last_interruption, time) < kApart;
}

/// The second signal ends a run that reaches no communication point. One that a unit sends is an
/// error of the unit.
void note_interruption(int signal, siginfo_t* info, void*) {
  end_if_own(signal, *info);
  const bool is_same = is_repeated();
  if (interrupted != 0 && !is_same) {
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
